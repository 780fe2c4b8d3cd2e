// What jobs will cost: CPU time, memory, disk.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "schema/store.hpp"

namespace haff::campaign {

class Forecast {
 public:
  // Speeds are taken from these jobs where they have run a gas of that density and size; others
  // are tried out when first asked for.
  explicit Forecast(const std::vector<schema::JobRow>& known);

  double cpu_seconds(const schema::Planned& plan);  // from the start to tau_max
  double memory_bytes(const schema::Job& job);      // of one worker
  double disk_bytes(const schema::Planned& plan) const;

  // Where the speeds come from, in words.
  std::string source() const;

 private:
  struct Work {
    double collisions = 0;
    double cpu_seconds = 0;
  };
  // Dimension, density, size, then kind and e, each -1 for any.
  using Gas = std::tuple<int, double, std::uint32_t, int, double>;

  double collisions_per_second(const schema::Job& job);
  double trial_speed(const schema::Job& job);

  std::map<Gas, Work> known_;
  std::map<Gas, double> trial_speeds_;
  std::map<std::pair<int, double>, double> bytes_per_particle_;  // by dimension and density
  bool used_store_ = false;
};

}  // namespace haff::campaign
