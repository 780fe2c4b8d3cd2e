// SPDX-License-Identifier: GPL-3.0-or-later

// One look at a store: where the campaign stands, and what to type next. `campaign status` prints
// it, the page of `campaign report` shows it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "campaign/accuracy/targets/targets.hpp"
#include "campaign/cluster/shards.hpp"
#include "campaign/results/series.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

struct Overview {
  std::filesystem::path path;
  schema::Summary summary;
  std::vector<schema::JobRow> jobs;
  std::vector<schema::RunningJob> running;
  std::vector<Series> series;
  std::vector<TargetProgress> targets;
  std::optional<schema::Invariants> worst;  // of all runs; nothing before the first
  std::vector<ShardStatus> shards;
  std::vector<std::string> mixed_physics;  // a sentence for each series concerned
};

Overview look(const schema::Reader& store);

double fraction_done(const schema::Summary& summary);  // of the expected CPU time, 0 ... 1

// The time until all planned work is done, if as many jobs run at a time as now; nothing while none
// runs. [s]
std::optional<double> seconds_left(const Overview& overview);

// The CPU time that finished jobs took, beside what was expected for them. [s]
struct ExpectedAndSpent {
  double expected = 0, spent = 0;
};
ExpectedAndSpent cost_of_done(const std::vector<schema::JobRow>& jobs);

// What to do now, in the order in which it helps.
std::vector<std::string> next_commands(const Overview& overview);

std::map<std::int64_t, schema::Status> status_of_each(const std::vector<schema::JobRow>& jobs);

// The failed equilibration that keeps a job from being run.
std::optional<std::int64_t> blocked_by(const schema::JobRow& row,
                                       const std::map<std::int64_t, schema::Status>& status_of);

}  // namespace haff::campaign
