#include "campaign/commands/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "campaign/accuracy/targets.hpp"
#include "campaign/base/command_text.hpp"
#include "campaign/base/duration.hpp"
#include "campaign/base/exit_code.hpp"
#include "campaign/base/job_text.hpp"
#include "campaign/base/machine.hpp"
#include "campaign/base/number_text.hpp"
#include "campaign/base/output.hpp"
#include "campaign/base/text_table.hpp"
#include "campaign/planning/advice.hpp"
#include "campaign/planning/expansion.hpp"
#include "campaign/planning/forecast.hpp"
#include "campaign/planning/preparation.hpp"
#include "campaign/results/box.hpp"
#include "schema/grid.hpp"
#include "schema/store.hpp"

namespace haff::campaign {
namespace {

using schema::Outcome;
using schema::Planned;

// A store without jobs: its tables, indexes and views. [bytes]
constexpr double empty_store_bytes = 100e3;

// Jobs of one line of the table.
struct Group {
  std::map<Outcome, int> outcomes;
  int jobs = 0;
  double cpu_seconds = 0;
  double disk_bytes = 0;
};

// Equilibrations first, then by d, e, n, N.
using GroupKey =
    std::tuple<schema::Kind, int, std::optional<double>, double, std::uint32_t, double>;

GroupKey group_of(const Planned& plan) {
  return {plan.job.kind, plan.job.d, plan.job.e, plan.job.n, plan.job.particles, plan.tau_max};
}

void expect(std::vector<Planned>& jobs, Forecast& forecast) {
  for (Planned& job : jobs) job.expected_cpu_seconds = forecast.cpu_seconds(job);
}

std::string counts_text(const std::map<Outcome, int>& outcomes, bool dry_run) {
  const auto count = [&](Outcome outcome) {
    const auto found = outcomes.find(outcome);
    return found == outcomes.end() ? 0 : found->second;
  };
  const int added = count(Outcome::added);
  const int extended = count(Outcome::extended);
  if (added == 0 && extended == 0)
    return dry_run ? "nothing would be added, all are in the store"
                   : "nothing was added, all are in the store";
  std::string text = fmt::format("{} {}", added, dry_run ? "would be added" : "added");
  if (extended > 0) text += fmt::format(", {} extended to a larger tau_max", extended);
  if (const int there = count(Outcome::unchanged)) text += fmt::format(", {} already there", there);
  return text;
}

void print(const std::vector<Planned>& jobs, const std::vector<Outcome>& outcomes,
           Forecast& forecast, bool dry_run) {
  std::map<GroupKey, Group> groups;
  std::map<Outcome, int> all;
  double cpu_seconds = 0;
  double memory = 0;
  double disk = empty_store_bytes;
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    const double expected = jobs[k].expected_cpu_seconds.value_or(0);
    Group& group = groups[group_of(jobs[k])];
    ++group.jobs;
    ++group.outcomes[outcomes[k]];
    group.cpu_seconds += expected;
    group.disk_bytes += forecast.disk_bytes(jobs[k]);
    ++all[outcomes[k]];
    cpu_seconds += expected;
    memory = std::max(memory, forecast.memory_bytes(jobs[k].job));
    disk += forecast.disk_bytes(jobs[k]);
  }

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
  for (auto& [key, group] : groups) {
    const auto& [kind, d, e, n, particles, tau_max] = key;
    table.add({std::string(name(kind)), count_text(d), e ? number_text(*e) : no_value,
               number_text(n), count_text(particles), number_text(tau_max), count_text(group.jobs),
               count_text(group.outcomes[Outcome::added]),
               count_text(group.outcomes[Outcome::extended]), duration_text(group.cpu_seconds),
               bytes_text(group.disk_bytes)});
  }
  say("{}\n", table.text());
  say("{} jobs: {}.\n", jobs.size(), counts_text(all, dry_run));
  say("Expected in all: {} of CPU time ({}), {} of memory for each worker, {} on disk.\n",
      duration_text(cpu_seconds), forecast.source(), bytes_text(memory), bytes_text(disk));
  if (const double all_workers = processors() * memory; all_workers > memory_bytes())
    say("Warning: {} workers, as many as `run` starts here, would take {} of memory; {} are there: "
        "run "
        "with --workers {}.\n",
        processors(), bytes_text(all_workers), bytes_text(memory_bytes()),
        std::max(1.0, std::floor(memory_bytes() / memory)));
}

// What the boxes of the plan can hold by linear theory, a line for each gas, and warnings.
void print_boxes(const std::vector<Planned>& jobs) {
  TextTable table({{"e"},
                   {"n"},
                   {"N"},
                   {"L"},
                   {"vortices"},
                   {"clusters"},
                   {"fastest wave"},
                   {"fit"},
                   {"grown by tau"}});
  std::set<std::tuple<int, double, double, std::uint32_t>> seen;
  std::vector<std::string> warnings;
  for (const auto& [job, tau_max, checkpoint_every, expected] : jobs) {
    const bool is_plain = job.kind == schema::Kind::cooling && job.e && job.effects == "{}";
    if (!is_plain || !seen.emplace(job.d, *job.e, job.n, job.particles).second) continue;
    const auto report = box_report(job);
    if (!report) continue;
    if (std::string warning = haff_warning(job, *report); !warning.empty())
      warnings.push_back(std::move(warning));
    const auto number = [](const std::optional<double>& value, int digits) {
      return value ? fmt::format("{:.{}f}", *value, digits) : std::string(no_value);
    };
    table.add({number_text(*job.e), number_text(job.n), count_text(job.particles),
               number(report->side, 1), number(report->vortices_across, 1),
               number(report->clusters_across, 1), number(report->fastest_wave, 1),
               number(report->waves_across, 0), number(report->grown_tau, 0)});
  }
  if (table.empty()) return;
  say("\nWhat the boxes can hold, by linear theory: how many of the shortest growing vortices "
      "(2 pi xi_perp) and\nclusters (2 pi xi_par) fit along L; the wave that grows fastest, how "
      "many "
      "of it fit, and the tau at which\nit has grown by a factor 2.72.\n\n{}",
      table.text());
  for (const std::string& warning : warnings) say("Warning: {}.\n", warning);
}

void print_advice(const std::vector<Planned>& jobs, const std::vector<schema::JobRow>& known) {
  print_boxes(jobs);
  for (const std::string& line : near_twins(jobs, known)) say("Note: {}\n", line);
  if (const std::size_t again = recomputed(jobs, known))
    say("Note: {} of the new jobs are of gases that the store has with other observables. What a "
        "job "
        "measures is\n  part of it: they are computed a second time.\n",
        again);
}

// What the targets will take beyond the jobs above, as far as runs that are done tell.
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

void print_next(const PlanOptions& options) {
  if (options.dry_run)
    say("Nothing was written. Next: {}\n",
        command_text("plan " + shell_word(options.grid.string()), options.store));
  else
    say("Next: {}\n", command_text("run", options.store));
}

}  // namespace

int plan(const PlanOptions& options) {
  const schema::Grid grid = schema::read_grid(options.grid, machine_memory(), why_not_prepared);
  std::vector<Planned> jobs = expand(grid);
  const std::vector<schema::Target> targets = targets_of(grid);
  if (!options.dry_run) {
    schema::Store store = schema::Store::create(options.store);
    const std::vector<schema::JobRow> known = store.jobs();
    Forecast forecast(known);
    expect(jobs, forecast);
    const std::vector<Outcome> outcomes = store.add(jobs);
    store.add(targets);
    keep_predictions(store);
    print(jobs, outcomes, forecast, false);
    print_advice(jobs, known);
    print_targets(progress_of(store, targets));
  } else if (std::filesystem::exists(options.store)) {
    const schema::Reader store(options.store);
    const std::vector<schema::JobRow> known = store.jobs();
    Forecast forecast(known);
    expect(jobs, forecast);
    print(jobs, store.preview(jobs), forecast, true);
    print_advice(jobs, known);
    print_targets(preview(store, jobs, targets));
  } else {
    Forecast forecast({});
    expect(jobs, forecast);
    print(jobs, std::vector(jobs.size(), Outcome::added), forecast, true);
    print_advice(jobs, {});
    print_targets(progress_of(jobs, targets));
  }
  print_next(options);
  return exit_complete;
}

}  // namespace haff::campaign
