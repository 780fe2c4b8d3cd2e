// SPDX-License-Identifier: GPL-3.0-or-later

// Targets: how far the standard errors asked for are.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/statistics.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

enum class Verdict {
  waiting,     // for runs that are planned: pilots first
  short_of,    // more realizations would help
  met,         // the standard error is what was asked for, or smaller
  unreachable  // more realizations would not help
};

std::string name(Verdict verdict);

std::string describe(const schema::Target& target);  // "a2, tau 5 to 15"

struct TargetProgress {
  schema::Target target;
  schema::Job job;  // of any realization
  Verdict verdict = Verdict::waiting;
  std::string reason = {};                   // why it is unreachable
  analysis::Estimate estimate = {};          // of all realizations so far; count 0: none yet
  std::optional<double> half_interval = {};  // of 95 %, once the pilots are done
  std::size_t planned = 0;                   // realizations there are jobs for
  std::size_t next = 0;                      // realizations to have before looking again
  std::size_t expected = 0;        // in all, as the scatter so far has it; 0: not known yet
  double cpu_seconds = 0;          // that those not yet planned will take
  double spent_cpu_seconds = 0;    // on those done, with equilibrations
  double pending_cpu_seconds = 0;  // that those planned still will
  std::optional<schema::CostPrediction> forecast = {};  // of all, once the pilots are done

  double cpu_seconds_to_come() const { return pending_cpu_seconds + cpu_seconds; }
};

// In the order given.
std::vector<TargetProgress> progress_of(const schema::Reader& store,
                                        const std::vector<schema::Target>& targets);

// Of targets with the jobs of their grid, before any of these is in a store.
std::vector<TargetProgress> progress_of(const std::vector<schema::Planned>& plan,
                                        const std::vector<schema::Target>& targets);

// Keeps what each target is expected to take, once its pilots are done: prediction and outcome can
// then be compared.
void keep_predictions(schema::Store& store);

// CPU time of all realizations not yet planned. Those of one series serve all its targets.
double cpu_seconds_unplanned(const std::vector<TargetProgress>& targets);

}  // namespace haff::campaign
