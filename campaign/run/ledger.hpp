// How much of a campaign's work is done, and when the rest will be.
//
// Jobs are weighed by the CPU time expected for them. The store says how far each was when it was
// last stored; the workers' reports say how far it is now.
#pragma once

#include <chrono>
#include <map>

#include "campaign/run/display.hpp"
#include "schema/store.hpp"

namespace haff::campaign {

class Ledger {
 public:
  explicit Ledger(const schema::Reader& store);

  void refresh(const schema::Reader& store);
  void note(const ProgressReport& report);
  Totals totals() const;

 private:
  struct Entry {
    double weight = 0;
    double fraction = 0;  // 0 ... 1
    schema::Status status = schema::Status::pending;
  };

  double done_weight() const;

  std::map<std::int64_t, Entry> jobs_;
  double weight_at_start_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace haff::campaign
