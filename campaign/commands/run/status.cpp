// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/run/status.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "campaign/accuracy/targets/table.hpp"
#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/duration.hpp"
#include "campaign/base/text/job_text.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/printable.hpp"
#include "campaign/base/text/text_table.hpp"
#include "campaign/commands/json_output.hpp"
#include "campaign/commands/run/watch.hpp"
#include "campaign/report/overview.hpp"
#include "campaign/report/overview_json.hpp"
#include "campaign/run/abandoned.hpp"

namespace haff::campaign {
namespace {

using nlohmann::ordered_json;
using schema::Kind;
using schema::Reader;
using schema::Status;

std::string jobs_table(const std::vector<schema::JobRow>& jobs) {
  std::map<std::pair<Status, Kind>, int> counts;
  for (const schema::JobRow& row : jobs) ++counts[{row.status, row.job.kind}];
  TextTable table({{"status", Align::left}, {"equilibrations"}, {"cooling"}, {"", Align::left}});
  for (const schema::StatusEntry& entry : schema::statuses)
    table.add({std::string(entry.name), count_text(counts[{entry.status, Kind::equilibration}]),
               count_text(counts[{entry.status, Kind::cooling}]), std::string(entry.meaning)});
  return table.text();
}

std::string running_table(const std::vector<schema::RunningJob>& running) {
  TextTable table({{"job"},
                   {"running", Align::left},
                   {"tau"},
                   {"tau_max"},
                   {"process"},
                   {"host", Align::left},
                   {"", Align::left}});
  for (const schema::RunningJob& job : running)
    table.add({std::to_string(job.lease.job_id), describe(job.job),
               fmt::format("{:.1f}", job.progress.tau), number_text(job.tau_max),
               std::to_string(job.owner.pid), job.owner.host,
               is_owner_dead(job) ? "is gone; the next run takes the job back" : ""});
  return table.text();
}

std::string shards_table(const std::vector<ShardStatus>& shards) {
  TextTable table({{"shard", Align::left},
                   {"jobs"},
                   {"still lent"},
                   {"done"},
                   {"CPU time"},
                   {"merged", Align::left},
                   {"Slurm", Align::left},
                   {"where", Align::left}});
  for (const ShardStatus& each : shards)
    table.add({each.shard.name, count_text(each.shard.jobs), count_text(each.shard.unfinished),
               each.fraction ? fmt::format("{:.1f} %", 100 * *each.fraction) : no_value,
               duration_text(each.shard.cpu_seconds), each.shard.merged.value_or(no_value),
               each.slurm.empty() ? no_value : each.slurm, each.where});
  return table.text();
}

std::string failures_text(const Overview& overview) {
  const auto status = status_of_each(overview.jobs);
  std::string text;
  std::map<std::int64_t, int> blocked;
  for (const schema::JobRow& row : overview.jobs) {
    if (row.status == Status::failed || row.status == Status::collapsed)
      text += fmt::format("job {} ({}) {}: {}\n", row.job_id, describe(row.job), name(row.status),
                          printable(row.error.value_or("for no reason known")));
    if (const auto id = blocked_by(row, status)) ++blocked[*id];
  }
  for (const auto& [id, count] : blocked)
    text += fmt::format("{} cooling job{} blocked: the equilibration, job {}, failed\n", count,
                        count == 1 ? " is" : "s are", id);
  return text;
}

std::string invariants_text(const schema::Invariants& worst) {
  return fmt::format(
      "Physics: overlap at most {:.1e} sigma, {} events in the past, {} unresolved collisions, "
      "energy "
      "balanced to {:.1e}, momentum to {:.1e}\n",
      worst.largest_overlap, worst.past_events, worst.unresolved_collisions, worst.energy_mismatch,
      worst.momentum_removed);
}

std::string next_text(const Overview& overview) {
  std::string text;
  for (const std::string& command : next_commands(overview))
    text += fmt::format("{}{}\n", text.empty() ? "Next: " : "      ", command);
  return text;
}

// The CPU time that finished jobs took, beside what was expected for them.
std::string cpu_time_text(const Overview& overview) {
  const schema::Summary& summary = overview.summary;
  std::string text =
      fmt::format("CPU time: {} spent, {} expected in all, {} of it to come\n",
                  duration_text(summary.cpu_seconds), duration_text(summary.expected_cpu_seconds),
                  duration_text(summary.remaining_cpu_seconds));
  if (const ExpectedAndSpent done = cost_of_done(overview.jobs); done.expected > 0)
    text += fmt::format("          jobs that are done took {}, {} was expected for them\n",
                        duration_text(done.spent), duration_text(done.expected));
  if (const auto left = seconds_left(overview))
    text += fmt::format("          with the jobs that run now, some {} from now\n",
                        duration_text(*left));
  if (const double more = cpu_seconds_unplanned(overview.targets); more > 0)
    text += fmt::format("          and some {} for the targets, beyond what is planned\n",
                        duration_text(more));
  return text;
}

// What a target was expected to take when its pilot runs were done, beside what it has taken.
std::string predictions_text(const std::vector<TargetProgress>& targets) {
  std::string text;
  for (const TargetProgress& each : targets)
    if (const auto& predicted = each.target.prediction)
      text += fmt::format(
          "{} (e {}, n {}, N {}): {} realizations and {} were expected after the pilot runs; "
          "{} are done and took {}\n",
          describe(each.target), e_text(each.job), number_text(each.job.n),
          count_text(each.job.particles),
          count_text(static_cast<long long>(predicted->realizations)),
          duration_text(predicted->cpu_seconds),
          count_text(static_cast<long long>(each.estimate.count)),
          duration_text(each.spent_cpu_seconds));
  return text;
}

// Series, targets, failures, and what to do.
std::string findings_text(const Overview& overview) {
  std::string text;
  const auto add = [&](const std::string& part) {
    if (!part.empty()) text += part + '\n';
  };
  if (!overview.series.empty()) add(series_table(overview.series));
  if (!overview.targets.empty()) add(targets_table(overview.targets));
  add(predictions_text(overview.targets));
  add(failures_text(overview));
  for (const std::string& sentence : overview.mixed_physics) text += "Note: " + sentence + '\n';
  return text + next_text(overview);
}

std::string overview_text(const Overview& overview) {
  const schema::Summary& summary = overview.summary;
  std::string text =
      fmt::format("{}: {} jobs, {:.1f} % of the work done\n\n{}\n{}\n", overview.path.string(),
                  overview.jobs.size(), 100 * fraction_done(summary), jobs_table(overview.jobs),
                  cpu_time_text(overview));
  if (overview.worst) text += invariants_text(*overview.worst) + '\n';
  if (!overview.running.empty()) text += running_table(overview.running) + '\n';
  if (!overview.shards.empty()) text += shards_table(overview.shards) + '\n';
  return text + findings_text(overview);
}

}  // namespace

int status(const StatusOptions& options) {
  bool has_warned = false;
  const auto once = [&] {
    const Reader store(options.store);
    if (store.lacks_log() && !std::exchange(has_warned, true))
      complain("campaign: {}: its newest rows may be missing, as the log beside it is; see: {}\n",
               options.store.string(), command_text("verify", options.store));
    const Overview overview = look(store);
    if (!options.json) return overview_text(overview);
    return options.watch_every ? one_line_json(overview_json(overview))
                               : indented_json(overview_json(overview));
  };
  if (options.watch_every) return watch(once, *options.watch_every, options.json);
  options.json ? print_data(once()) : print_lines(once());
  return exit_complete;
}

void print_outcome(const Reader& store) {
  print_lines(findings_text(look(store)));
}

void print_outcome_json(const Reader& store, int exit_code, std::int64_t not_chosen) {
  ordered_json outcome = overview_json(look(store));
  outcome["not_chosen"] = not_chosen;
  outcome["exit_code"] = exit_code;
  print_data(indented_json(outcome));
}

}  // namespace haff::campaign
