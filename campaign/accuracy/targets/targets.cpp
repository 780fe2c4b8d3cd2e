// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/accuracy/targets/targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "analysis/statistics/accuracy.hpp"
#include "campaign/accuracy/quantity.hpp"
#include "campaign/results/finished_runs.hpp"

namespace haff::campaign {
namespace {

// The jobs of one series.
struct Runs {
  std::vector<schema::JobRow> rows;
  std::size_t open = 0;  // pending or running
  double to_come = 0;    // CPU time of these, with equilibrations
};

bool is_open(const schema::JobRow& row) {
  return row.status == schema::Status::pending || row.status == schema::Status::running;
}

double cpu_seconds_to_come(const schema::JobRow& row) {
  if (!is_open(row)) return 0;
  return row.expected_cpu_seconds.value_or(0) * std::max(0.0, 1 - row.progress.tau / row.tau_max);
}

std::map<std::string, Runs> runs_by_series(const schema::Reader& store) {
  std::map<std::string, Runs> all;
  std::map<std::int64_t, double> before;  // of equilibrations, which come first in tables
  for (schema::JobRow& row : store.jobs()) {
    if (row.job.kind != schema::Kind::cooling) {
      before[row.job_id] = cpu_seconds_to_come(row);
      continue;
    }
    Runs& runs = all[row.series];
    if (is_open(row)) {
      ++runs.open;
      runs.to_come += before[*row.equilibration_id] + cpu_seconds_to_come(row);
    }
    runs.rows.push_back(std::move(row));
  }
  return all;
}

double spent_cpu_seconds(const FinishedSeries& series) {
  double sum = 0;
  for (const FinishedRun& run : series.runs) sum += run.cpu_seconds + run.equilibration_cpu_seconds;
  return sum;
}

double mean_cpu_seconds(const FinishedSeries& series) {
  return spent_cpu_seconds(series) / static_cast<double>(series.runs.size());
}

// What the finished realizations tell about a target.
struct Values {
  std::vector<double> all;
  std::size_t without = 0;  // realizations that have no such value
};

Values values_of(const schema::Target& target, const FinishedSeries& series) {
  Values values;
  for (const FinishedRun& run : series.runs) {
    const auto value = value_of(quantity_of(target), series.job, run);
    if (!value) {
      ++values.without;
      continue;
    }
    values.all.push_back(*value);
  }
  return values;
}

std::string reason_for(const schema::Target& target, const Values& values,
                       const FinishedSeries& series) {
  if (values.without == 0) return "a pilot run did not end as done";
  return fmt::format("{} of {} runs have no {}{}", values.without, series.runs.size(),
                     target.quantity, target.quantity == "tau_c" ? ": plan a larger tau_max" : "");
}

void judge(TargetProgress& progress, const Runs& runs, const FinishedSeries& series) {
  const schema::Target& target = progress.target;
  const Values values = values_of(target, series);
  progress.pending_cpu_seconds = runs.to_come;
  progress.spent_cpu_seconds = spent_cpu_seconds(series);
  if (!values.all.empty()) progress.estimate = analysis::estimate(values.all);
  if (values.all.size() >= 2) {
    const double deviation = analysis::standard_deviation(progress.estimate);
    progress.expected = std::max(
        {analysis::realizations_needed(deviation, target.se), runs.rows.size(), values.all.size()});
    progress.cpu_seconds =
        mean_cpu_seconds(series) * static_cast<double>(progress.expected - runs.rows.size());
  }
  progress.half_interval = half_interval(target, series);
  const bool pilots_done = progress.half_interval.has_value();
  const bool lies_ahead =
      values.all.size() == target.pilots.size() || progress.expected > values.all.size();
  if (pilots_done && lies_ahead)
    progress.forecast = {progress.expected,
                         mean_cpu_seconds(series) * static_cast<double>(progress.expected)};
  if (runs.open > 0) return;  // waiting

  if (!pilots_done || values.without > 0) {
    progress.verdict = Verdict::unreachable;
    progress.reason = reason_for(target, values, series);
    progress.cpu_seconds = 0;
    progress.forecast = std::nullopt;
    return;
  }
  progress.next = analysis::next_realizations(progress.estimate, target.se);
  progress.verdict = progress.next > values.all.size() ? Verdict::short_of : Verdict::met;
  if (progress.verdict == Verdict::met) progress.cpu_seconds = 0;
}

}  // namespace

std::string name(Verdict verdict) {
  switch (verdict) {
    case Verdict::waiting:
      return "waits for runs";
    case Verdict::short_of:
      return "not met yet";
    case Verdict::met:
      return "met";
    case Verdict::unreachable:
      return "cannot be met";
  }
  throw std::logic_error("unknown verdict");
}

std::string describe(const schema::Target& target) {
  return describe(quantity_of(target));
}

std::vector<TargetProgress> progress_of(const schema::Reader& store,
                                        const std::vector<schema::Target>& targets) {
  if (targets.empty()) return {};
  std::set<std::string> wanted;
  for (const schema::Target& target : targets) wanted.insert(target.series);
  const auto runs = runs_by_series(store);
  std::map<std::string, FinishedSeries> finished;
  for (FinishedSeries& series : read_finished_runs(store, wanted))
    finished.emplace(schema::series_identity(series.job), std::move(series));

  std::vector<TargetProgress> all;
  for (const schema::Target& target : targets) {
    const auto found = runs.find(target.series);
    if (found == runs.end()) continue;  // a dry run: none of its jobs is planned
    TargetProgress progress{.target = target, .job = found->second.rows.front().job};
    progress.planned = found->second.rows.size();
    const auto found_runs = finished.find(target.series);
    judge(progress, found->second,
          found_runs != finished.end() ? found_runs->second
                                       : FinishedSeries{.job = progress.job, .runs = {}});
    all.push_back(std::move(progress));
  }
  return all;
}

std::vector<TargetProgress> progress_of(const std::vector<schema::Planned>& plan,
                                        const std::vector<schema::Target>& targets) {
  std::map<std::string, std::pair<const schema::Job*, Runs>> runs;
  std::map<std::string, double> equilibrations;
  for (const schema::Planned& each : plan)
    if (each.job.kind == schema::Kind::equilibration)
      equilibrations[schema::identity(each.job)] = each.expected_cpu_seconds.value_or(0);
  for (const schema::Planned& each : plan) {
    if (each.job.kind == schema::Kind::equilibration) continue;
    auto& [job, all] = runs[schema::series_identity(each.job)];
    job = &each.job;
    ++all.open;
    all.to_come += each.expected_cpu_seconds.value_or(0) +
                   equilibrations[schema::identity(schema::equilibration_of(each.job))];
  }
  std::vector<TargetProgress> progress;
  for (const schema::Target& target : targets) {
    const auto& [job, all] = runs.at(target.series);
    progress.push_back(
        {.target = target, .job = *job, .planned = all.open, .pending_cpu_seconds = all.to_come});
  }
  return progress;
}

void keep_predictions(schema::Store& store) {
  for (const TargetProgress& each : progress_of(store, store.targets()))
    if (each.forecast && !each.target.prediction) store.predict(each.target, *each.forecast);
}

double cpu_seconds_unplanned(const std::vector<TargetProgress>& targets) {
  std::map<std::string, double> by_series;
  for (const TargetProgress& each : targets) {
    double& most = by_series[each.target.series];
    most = std::max(most, each.cpu_seconds);
  }
  double sum = 0;
  for (const auto& [series, seconds] : by_series) sum += seconds;
  return sum;
}

}  // namespace haff::campaign
