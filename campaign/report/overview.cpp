// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/report/overview.hpp"

#include <algorithm>

#include "campaign/base/process/would_fail_again.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/results/mixed_physics.hpp"
#include "campaign/run/abandoned.hpp"

namespace haff::campaign {
namespace {

using schema::Reader;
using schema::Status;

// The largest overlap, mismatch and momentum of all runs, and all counts together.
std::optional<schema::Invariants> worst_invariants(const Reader& store) {
  auto rows = store.query(
      "SELECT max(largest_overlap), sum(past_events), sum(unresolved_collisions), "
      "max(energy_mismatch), "
      "max(momentum_removed) FROM invariants");
  const auto row = rows.next().value();
  const auto* overlap = std::get_if<double>(row.data());
  if (!overlap) return std::nullopt;
  return schema::Invariants{.largest_overlap = *overlap,
                            .past_events = std::get<std::int64_t>(row[1]),
                            .unresolved_collisions = std::get<std::int64_t>(row[2]),
                            .energy_mismatch = std::get<double>(row[3]),
                            .momentum_removed = std::get<double>(row[4])};
}

// CPU time that a job still needs. [s]
double seconds_to_come(const schema::JobRow& row) {
  const double left = std::clamp(1 - row.progress.tau / row.tau_max, 0.0, 1.0);
  return row.expected_cpu_seconds.value_or(0) * left;
}

}  // namespace

Overview look(const Reader& store) {
  return {store.path(),
          store.summary(),
          store.jobs(),
          store.running(),
          series_of(store),
          progress_of(store, store.targets()),
          worst_invariants(store),
          shard_states(store),
          mixed_physics(store)};
}

double fraction_done(const schema::Summary& summary) {
  if (summary.expected_cpu_seconds <= 0) return 0;
  return summary.reached_cpu_seconds / summary.expected_cpu_seconds;
}

std::optional<double> seconds_left(const Overview& overview) {
  const auto at_work = std::ranges::count_if(
      overview.running, [](const schema::RunningJob& job) { return !is_owner_dead(job); });
  if (at_work == 0) return std::nullopt;
  double all = 0, longest = 0;
  for (const schema::JobRow& row : overview.jobs)
    if (row.status == Status::pending || row.status == Status::running) {
      all += seconds_to_come(row);
      longest = std::max(longest, seconds_to_come(row));
    }
  return std::max(all / static_cast<double>(at_work), longest);
}

ExpectedAndSpent cost_of_done(const std::vector<schema::JobRow>& jobs) {
  ExpectedAndSpent cost;
  for (const schema::JobRow& row : jobs)
    if (row.status == Status::done && row.expected_cpu_seconds) {
      cost.expected += *row.expected_cpu_seconds;
      cost.spent += row.progress.cpu_seconds;
    }
  return cost;
}

std::vector<std::string> next_commands(const Overview& overview) {
  const schema::Summary& summary = overview.summary;
  std::vector<std::string> commands;
  const bool may_succeed = std::ranges::any_of(overview.jobs, [](const schema::JobRow& row) {
    return row.status == Status::failed &&
           row.error.value_or("").find(would_fail_again) == std::string::npos;
  });
  if (may_succeed) commands.emplace_back("retry");
  const bool abandoned = std::ranges::any_of(overview.running, is_owner_dead);
  const bool nothing_runs = overview.running.empty() || abandoned;
  const bool short_of_target = std::ranges::any_of(
      overview.targets,
      [](const TargetProgress& target) { return target.verdict == Verdict::short_of; });
  if (nothing_runs &&
      (abandoned || !commands.empty() || short_of_target || summary.jobs.at(Status::pending) > 0))
    commands.emplace_back("run");
  if (summary.jobs.at(Status::done) > 0 && commands.empty() && overview.running.empty())
    commands.emplace_back("figures");
  if (overview.jobs.empty()) commands.emplace_back("plan GRID.json");
  for (std::string& command : commands) command = command_text(command, overview.path);
  return commands;
}

std::optional<std::int64_t> blocked_by(const schema::JobRow& row,
                                       const std::map<std::int64_t, Status>& status_of) {
  if (row.status != Status::pending || !row.equilibration_id) return std::nullopt;
  const auto found = status_of.find(*row.equilibration_id);
  const bool blocked = found != status_of.end() && found->second == Status::failed;
  return blocked ? row.equilibration_id : std::nullopt;
}

std::map<std::int64_t, Status> status_of_each(const std::vector<schema::JobRow>& jobs) {
  std::map<std::int64_t, Status> status;
  for (const schema::JobRow& row : jobs) status[row.job_id] = row.status;
  return status;
}

}  // namespace haff::campaign
