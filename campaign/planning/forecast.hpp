// SPDX-License-Identifier: GPL-3.0-or-later

// What jobs will cost: CPU time, memory, disk.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "campaign/planning/calibration.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

class Forecast {
 public:
  // Speeds are taken from these jobs where they have run the same gas, with the same effects and
  // measurements; others are tried out when first asked for.
  explicit Forecast(const std::vector<schema::JobRow>& known);

  double cpu_seconds(const schema::Planned& plan);  // from the start to tau_max
  double memory_bytes(const schema::Job& job);      // of one worker
  double disk_bytes(const schema::Planned& plan);

  // Where the speeds come from, in words.
  std::string source() const;

 private:
  struct Work {
    double collisions = 0;
    double cpu_seconds = 0;
  };

  std::optional<double> known_seconds_per_collision(const schema::Job& job);
  const Prices& prices(const schema::Planned& plan);
  const Sizes& sizes_of(const schema::Job& job);
  double waiting_snapshots_bytes(const schema::Job& job);

  // By what makes a job fast or slow.
  std::map<std::string, Work> known_;
  std::map<std::string, Prices> tried_;
  std::map<std::tuple<int, double, schema::Effects>, Sizes> sizes_;  // by d, n, effects
  bool used_store_ = false;
};

}  // namespace haff::campaign
