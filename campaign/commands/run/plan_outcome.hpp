// SPDX-License-Identifier: GPL-3.0-or-later

// What planning a grid did, or would do, and what it will cost.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "campaign/accuracy/targets/targets.hpp"
#include "campaign/planning/forecast.hpp"
#include "campaign/planning/run_time.hpp"
#include "campaign/results/box.hpp"
#include "schema/store/planning/revision.hpp"

namespace haff::campaign {

// Jobs that differ only in what the table of a plan leaves out: seed, effects, observables.
struct PlanGroup {
  schema::Job job;  // any of them
  double tau_max = 0;
  int jobs = 0, added = 0, extended = 0;
  double cpu_seconds = 0;  // expected
  double disk_bytes = 0;
};

struct PlannedBox {
  schema::Job job;  // any of the gas
  BoxReport report;
};

struct PlanOutcome {
  bool dry_run = false;
  int jobs = 0, added = 0, extended = 0, unchanged = 0;
  std::vector<PlanGroup> groups;  // equilibrations first, then by d, e, n, N, tau_max
  double cpu_seconds = 0;         // expected in all
  RunTime run_time;               // with a worker for each processor of this machine
  std::string cpu_source;         // where the expectation comes from, in words
  double memory_bytes = 0;        // of each worker
  double disk_bytes = 0;
  std::string memory_warning;     // empty: as many workers as processors fit
  std::vector<PlannedBox> boxes;  // of plain gases, a gas each
  std::vector<std::string> box_warnings;
  std::vector<std::string> notes;
  std::vector<TargetProgress> targets;  // what they will take beyond the jobs above
  // For a grid that replaces the plan: which jobs go, end earlier or stay.
  std::optional<schema::Revision> revision;
  std::string next;  // the command to type
};

// All but targets, revision and next. `known`: the store's jobs before.
PlanOutcome plan_outcome(const std::vector<schema::Planned>& jobs,
                         const std::vector<schema::Outcome>& outcomes, Forecast& forecast,
                         const std::vector<schema::JobRow>& known, bool dry_run);

nlohmann::ordered_json plan_json(const PlanOutcome& outcome);

}  // namespace haff::campaign
