// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/run/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "campaign/accuracy/targets/table.hpp"
#include "campaign/accuracy/targets/targets.hpp"
#include "campaign/base/output/output.hpp"
#include "campaign/base/process/exit_code.hpp"
#include "campaign/base/process/machine.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/duration.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/text_table.hpp"
#include "campaign/commands/json_output.hpp"
#include "campaign/commands/revision_text.hpp"
#include "campaign/commands/run/plan_outcome.hpp"
#include "campaign/planning/expansion.hpp"
#include "campaign/planning/forecast.hpp"
#include "campaign/planning/given_states.hpp"
#include "campaign/planning/preparation.hpp"
#include "campaign/run/abandoned.hpp"
#include "schema/grid/grid.hpp"
#include "schema/store/planning/revision.hpp"

namespace haff::campaign {
namespace {

using schema::Outcome;
using schema::Planned;

void expect(std::vector<Planned>& jobs, Forecast& forecast) {
  for (Planned& job : jobs) job.expected_cpu_seconds = forecast.cpu_seconds(job);
}

std::string counts_text(const PlanOutcome& outcome) {
  if (outcome.added == 0 && outcome.extended == 0)
    return outcome.dry_run ? "nothing would be added, all are in the store"
                           : "nothing was added, all are in the store";
  std::string text =
      fmt::format("{} {}", outcome.added, outcome.dry_run ? "would be added" : "added");
  if (outcome.extended > 0)
    text += fmt::format(", {} extended to a larger tau_max", outcome.extended);
  if (outcome.unchanged > 0) text += fmt::format(", {} already there", outcome.unchanged);
  return text;
}

// The time of a run on this machine alone; empty where it would repeat the CPU time.
std::string run_time_text(const RunTime& time) {
  const int workers = processors();
  if (workers == 1) return "";
  return fmt::format("With {} workers, one for each processor here, {} in all{}.\n", workers,
                     duration_text(time.seconds),
                     time.most_threads == 1
                         ? ""
                         : fmt::format("; while fewer jobs than workers are left, a large one gets "
                                       "up to {} threads",
                                       time.most_threads));
}

void print_jobs(const PlanOutcome& outcome) {
  TextTable table({{"kind", Align::left},
                   {"d"},
                   {"e"},
                   {"n"},
                   {"N"},
                   {"tau_max"},
                   {"jobs"},
                   {"new"},
                   {"extended"},
                   {"CPU time"},
                   {"disk"}});
  for (const PlanGroup& group : outcome.groups)
    table.add({std::string(name(group.job.kind)), count_text(group.job.d),
               group.job.e ? number_text(*group.job.e) : no_value, number_text(group.job.n),
               count_text(group.job.particles), number_text(group.tau_max), count_text(group.jobs),
               count_text(group.added), count_text(group.extended),
               duration_text(group.cpu_seconds), bytes_text(group.disk_bytes)});
  say("{}\n", table.text());
  say("{} jobs: {}.\n", outcome.jobs, counts_text(outcome));
  say("Expected in all: {} of CPU time ({}), {} of memory for each worker, {} on disk.\n",
      duration_text(outcome.cpu_seconds), outcome.cpu_source, bytes_text(outcome.memory_bytes),
      bytes_text(outcome.disk_bytes));
  say("{}", run_time_text(outcome.run_time));
  if (!outcome.memory_warning.empty()) say("Warning: {}.\n", outcome.memory_warning);
}

// Which unstable modes the boxes of the plan can hold by linear theory, a line for each gas, and
// warnings.
void print_boxes(const PlanOutcome& outcome) {
  TextTable table({{"e"},
                   {"n"},
                   {"N"},
                   {"L"},
                   {"vortices"},
                   {"clusters"},
                   {"fastest wave"},
                   {"fit"},
                   {"grown by tau"}});
  for (const auto& [job, report] : outcome.boxes) {
    const auto number = [](const std::optional<double>& value, int digits) {
      return value ? fmt::format("{:.{}f}", *value, digits) : std::string(no_value);
    };
    table.add({number_text(*job.e), number_text(job.n), count_text(job.particles),
               number(report.side, 1), number(report.vortices_across, 1),
               number(report.clusters_across, 1), number(report.fastest_wave, 1),
               number(report.waves_across, 0), number(report.grown_tau, 0)});
  }
  if (table.empty()) return;
  say("\nWhat the boxes can hold, by linear theory: how many of the shortest growing vortices "
      "(2 pi xi_perp) and\nclusters (2 pi xi_par) fit along L; the wave that grows fastest, how "
      "many "
      "of it fit, and the tau at which\nit has grown by a factor 2.72.\n\n{}",
      table.text());
  for (const std::string& warning : outcome.box_warnings) say("Warning: {}.\n", warning);
}

// What the targets will take beyond the jobs above, as far as finished runs tell.
void print_targets(const std::vector<TargetProgress>& targets) {
  if (targets.empty()) return;
  say("\n{}\n", targets_table(targets));
  if (const double more = cpu_seconds_unplanned(targets); more > 0)
    say("Beyond the jobs above, targets will take some {} of CPU time.\n", duration_text(more));
  const auto unknown = std::ranges::find(targets, 0U, &TargetProgress::expected);
  if (unknown != targets.end())
    say("A target's pilot runs, the {} seeds of the grid, come first. They tell how many "
        "realizations it takes:\nplan again once they are done, or look at `status`; `run` adds "
        "the others by itself.\n",
        unknown->target.pilots.size());
}

void print(const PlanOutcome& outcome) {
  print_jobs(outcome);
  print_boxes(outcome);
  if (outcome.revision) say("{}", revision_text(*outcome.revision));
  for (const std::string& note : outcome.notes) say("Note: {}\n", note);
  print_targets(outcome.targets);
  say("{}Next: {}\n", outcome.dry_run ? "Nothing was written. " : "", outcome.next);
}

// Those the store does not have yet as they will be.
std::vector<TargetProgress> preview(const schema::Reader& store, const std::vector<Planned>& jobs,
                                    const std::vector<schema::Target>& targets) {
  std::vector<TargetProgress> all;
  for (TargetProgress& planned : progress_of(jobs, targets)) {
    std::vector<TargetProgress> there = progress_of(store, {planned.target});
    all.push_back(std::move(there.empty() ? planned : there.front()));
  }
  return all;
}

// Writes to the store, unless it is only asked what that would do.
PlanOutcome plan_into_store(std::vector<Planned>& jobs, const std::vector<schema::Target>& targets,
                            const PlanOptions& options) {
  if (!options.dry_run) {
    schema::Revised store(schema::Store::create(options.store));
    const std::vector<schema::JobRow> known = store.jobs();
    Forecast forecast(known);
    expect(jobs, forecast);
    std::optional<schema::Revision> revision;
    if (options.replace) {
      take_back_from_the_dead(store);
      revision = store.replace(jobs, targets);
    }
    const std::vector<Outcome> outcomes = revision ? revision->outcomes : store.add(jobs);
    store.add(targets);
    keep_predictions(store);
    // A longer plan is no news where it has just been made shorter.
    PlanOutcome outcome =
        plan_outcome(jobs, outcomes, forecast, revision ? store.jobs() : known, false);
    outcome.revision = std::move(revision);
    outcome.targets = progress_of(store, targets);
    return outcome;
  }
  if (std::filesystem::exists(options.store)) {
    const schema::Reader store(options.store);
    const std::vector<schema::JobRow> known = store.jobs();
    Forecast forecast(known);
    expect(jobs, forecast);
    PlanOutcome outcome = plan_outcome(jobs, store.preview(jobs), forecast, known, true);
    if (options.replace) outcome.revision = revision_of_replace(store, jobs, targets);
    outcome.targets = preview(store, jobs, targets);
    return outcome;
  }
  Forecast forecast({});
  expect(jobs, forecast);
  PlanOutcome outcome =
      plan_outcome(jobs, std::vector(jobs.size(), Outcome::added), forecast, {}, true);
  outcome.targets = progress_of(jobs, targets);
  return outcome;
}

}  // namespace

int plan(const PlanOptions& options) {
  const schema::Grid grid = schema::read_grid(options.grid, machine_memory(), why_not_prepared);
  GivenStates given;
  const auto read_state = [&](const schema::AskedStart& asked, const schema::Job& job) {
    return given.state_of(asked, job);
  };
  std::vector<Planned> jobs = expand(grid, read_state);
  PlanOutcome outcome = plan_into_store(jobs, targets_of(grid, read_state), options);
  const std::string again = fmt::format("plan {}{}", options.replace ? "--replace " : "",
                                        shell_word(options.grid.string()));
  outcome.next = command_text(options.dry_run ? again : "run", options.store);
  if (options.json)
    print_json(plan_json(outcome));
  else
    print(outcome);
  return exit_complete;
}

}  // namespace haff::campaign
