// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/run/plan_outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "campaign/base/process/machine.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/commands/revision_text.hpp"
#include "campaign/planning/advice.hpp"
#include "campaign/report/overview_json.hpp"

namespace haff::campaign {
namespace {

using nlohmann::ordered_json;
using schema::Outcome;
using schema::Planned;

// A store without jobs: its tables, indexes and views. [bytes]
constexpr double empty_store_bytes = 180e3;

// Equilibrations first, then by d, e, n, N.
using GroupKey =
    std::tuple<schema::Kind, int, std::optional<double>, double, std::uint32_t, double>;

GroupKey group_of(const Planned& plan) {
  return {plan.job.kind, plan.job.d, plan.job.e, plan.job.n, plan.job.particles, plan.tau_max};
}

void add_groups(const std::vector<Planned>& jobs, const std::vector<Outcome>& outcomes,
                Forecast& forecast, PlanOutcome& found) {
  std::map<GroupKey, PlanGroup> groups;
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    PlanGroup& group = groups[group_of(jobs[k])];
    group.job = jobs[k].job;
    group.tau_max = jobs[k].tau_max;
    ++group.jobs;
    group.added += outcomes[k] == Outcome::added;
    group.extended += outcomes[k] == Outcome::extended;
    found.unchanged += outcomes[k] == Outcome::unchanged;
    group.cpu_seconds += jobs[k].expected_cpu_seconds.value_or(0);
    group.disk_bytes += forecast.disk_bytes(jobs[k]);
    found.cpu_seconds += jobs[k].expected_cpu_seconds.value_or(0);
    found.disk_bytes += forecast.disk_bytes(jobs[k]);
    found.memory_bytes = std::max(found.memory_bytes, forecast.memory_bytes(jobs[k].job));
  }
  for (auto& [key, group] : groups) {
    found.added += group.added;
    found.extended += group.extended;
    found.groups.push_back(std::move(group));
  }
}

std::string memory_warning(double memory) {
  const double all_workers = processors() * memory;
  if (all_workers <= memory_bytes()) return "";
  return fmt::format(
      "{} workers, as many as `run` starts here, would take {} of memory; {} are there: run with "
      "--workers {}",
      processors(), bytes_text(all_workers), bytes_text(memory_bytes()),
      std::max(1.0, std::floor(memory_bytes() / memory)));
}

void add_boxes(const std::vector<Planned>& jobs, PlanOutcome& found) {
  std::set<std::tuple<int, double, double, std::uint32_t>> seen;
  for (const Planned& planned : jobs) {
    const schema::Job& job = planned.job;
    const bool is_plain = job.kind == schema::Kind::cooling && job.e && job.effects.none();
    if (!is_plain || !seen.emplace(job.d, *job.e, job.n, job.particles).second) continue;
    const auto report = box_report(job);
    if (!report) continue;
    if (std::string warning = haff_warning(job, *report); !warning.empty())
      found.box_warnings.push_back(std::move(warning));
    found.boxes.push_back({job, *report});
  }
}

// Jobs that the store still has to run further than the plan asks.
std::size_t planned_longer(const std::vector<Planned>& jobs,
                           const std::vector<schema::JobRow>& known) {
  std::map<std::string, double> open;
  for (const schema::JobRow& row : known)
    if (row.status == schema::Status::pending && row.job.kind == schema::Kind::cooling)
      open.emplace(identity(row.job), row.tau_max);
  if (open.empty()) return 0;
  return static_cast<std::size_t>(std::ranges::count_if(jobs, [&](const Planned& planned) {
    const auto found = open.find(identity(planned.job));
    return found != open.end() && found->second > planned.tau_max;
  }));
}

ordered_json group_json(const PlanGroup& group) {
  return {{"kind", name(group.job.kind)},
          {"d", group.job.d},
          {"e", group.job.e ? ordered_json(*group.job.e) : ordered_json(nullptr)},
          {"n", group.job.n},
          {"particles", group.job.particles},
          {"tau_max", group.tau_max},
          {"jobs", group.jobs},
          {"added", group.added},
          {"extended", group.extended},
          {"expected_cpu_seconds", group.cpu_seconds},
          {"disk_bytes", group.disk_bytes}};
}

}  // namespace

PlanOutcome plan_outcome(const std::vector<Planned>& jobs, const std::vector<Outcome>& outcomes,
                         Forecast& forecast, const std::vector<schema::JobRow>& known,
                         bool dry_run) {
  PlanOutcome found;
  found.dry_run = dry_run;
  found.jobs = static_cast<int>(jobs.size());
  found.disk_bytes = empty_store_bytes;
  add_groups(jobs, outcomes, forecast, found);
  found.cpu_source = forecast.source();
  found.run_time = expected_run_time(jobs, processors());
  found.memory_warning = memory_warning(found.memory_bytes);
  add_boxes(jobs, found);
  found.notes = near_twins(jobs, known);
  if (const std::size_t longer = planned_longer(jobs, known))
    found.notes.push_back(fmt::format(
        "{} job{} already planned to a larger tau_max than this grid has, and will be run to it; "
        "plan --replace lowers it.",
        longer, longer == 1 ? " is" : "s are"));
  if (const std::size_t again = recomputed(jobs, known))
    found.notes.push_back(fmt::format(
        "{} of the new jobs are of gases that the store has with other observables. What a job "
        "measures is part of it: they are computed a second time.",
        again));
  return found;
}

ordered_json plan_json(const PlanOutcome& outcome) {
  ordered_json object{{"dry_run", outcome.dry_run},
                      {"jobs", outcome.jobs},
                      {"added", outcome.added},
                      {"extended", outcome.extended},
                      {"unchanged", outcome.unchanged},
                      {"expected_cpu_seconds", outcome.cpu_seconds},
                      {"expected_from", outcome.cpu_source},
                      {"expected_seconds", outcome.run_time.seconds},
                      {"workers", processors()},
                      {"most_threads_of_worker", outcome.run_time.most_threads},
                      {"memory_bytes_of_worker", outcome.memory_bytes},
                      {"disk_bytes", outcome.disk_bytes},
                      {"groups", ordered_json::array()},
                      {"boxes", ordered_json::array()},
                      {"targets", ordered_json::array()},
                      {"warnings", outcome.box_warnings},
                      {"notes", outcome.notes},
                      {"next", outcome.next}};
  if (!outcome.memory_warning.empty()) object["warnings"].push_back(outcome.memory_warning);
  for (const PlanGroup& group : outcome.groups) object["groups"].push_back(group_json(group));
  for (const PlannedBox& box : outcome.boxes)
    object["boxes"].push_back({{"d", box.job.d},
                               {"e", *box.job.e},
                               {"n", box.job.n},
                               {"particles", box.job.particles},
                               {"box", box_json(box.job)}});
  if (outcome.revision) object["replaced"] = revision_json(*outcome.revision);
  for (const TargetProgress& target : outcome.targets)
    object["targets"].push_back(target_json(target));
  return object;
}

}  // namespace haff::campaign
