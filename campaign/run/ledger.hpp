// SPDX-License-Identifier: GPL-3.0-or-later

// How much of the work of a run is done, and when the rest will be.
//
// Its jobs, all of the store or those that were chosen, are weighed by the CPU time expected for
// them. The store says how far each was when it was last stored; the workers' reports say how far
// it is now. A look at the store reads what may have changed: the jobs that run, ran at the last
// look or were reported since. All jobs are read again only when the counts by status tell that
// something else has changed, and then seldom.
#pragma once

#include <chrono>
#include <map>
#include <set>

#include "campaign/run/display.hpp"
#include "schema/store/planning/choice.hpp"

namespace haff::campaign {

class Ledger {
 public:
  explicit Ledger(const schema::Selection& store);

  void refresh(const schema::Selection& store);
  void note(const ProgressReport& report);
  Totals totals() const;

 private:
  using Clock = std::chrono::steady_clock;

  struct Entry {
    double weight = 0;
    double fraction = 0;  // 0 ... 1
    schema::Status status = schema::Status::pending;
  };

  void read_all(const schema::Selection& store);
  void update(const schema::JobRow& row);
  bool agrees_with(const std::map<schema::Status, std::int64_t>& counts) const;
  double done_weight() const;

  std::map<std::int64_t, Entry> jobs_;
  std::map<schema::Status, std::int64_t> counts_;
  std::set<std::int64_t> restless_;  // jobs that ran at the last look, or were reported since
  Clock::time_point next_read_of_all_;
  double weight_at_start_ = 0;
  Clock::time_point start_;
};

}  // namespace haff::campaign
