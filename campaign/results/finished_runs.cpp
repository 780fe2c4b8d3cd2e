// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/results/finished_runs.hpp"

#include <cmath>
#include <map>

#include "analysis/observables/velocity_correlations.hpp"
#include "analysis/theory/correlations.hpp"
#include "campaign/state/restore.hpp"

namespace haff::campaign {
namespace {

// The last state is in the store: whatever the run measured, it can be looked at once more.
std::optional<MeshTrial> mesh_trial(const schema::Reader& store, const schema::JobRow& row) {
  const auto state = newest_state(store, row.job_id, row.job);
  if (!state || !(state->box > 8 * wide_cell)) return std::nullopt;
  const double tau = 2 * static_cast<double>(state->collisions) / state->particles();
  const double k_max = analysis::cutoff_wavenumber(row.job.n, analysis::cutoff_b, row.job.d);
  const auto measured = [&](double cell) {
    auto g = analysis::velocity_correlations(state->position, state->velocity, state->box, k_max,
                                             row.job.d, cell);
    for (double& value : g.parallel) value = std::ldexp(value, -2 * state->exponent);
    return schema::Profile{"G_parallel", tau, std::move(g.r), std::move(g.parallel)};
  };
  return MeshTrial{measured(1), measured(wide_cell)};
}

void read_correlations(const schema::Reader& store, const schema::JobRow& row, FinishedRun& run) {
  if (!row.job.profiles_every) return;
  run.correlations = store.profiles(row.job_id, "G_parallel");
  if (!run.correlations.empty()) run.mesh = mesh_trial(store, row);
}

// Of the series wanted; `complete` adds to each run what its row leads to.
template <class Wanted, class Complete>
std::vector<FinishedSeries> read_those(const schema::Reader& store, Wanted&& wanted,
                                       Complete&& complete) {
  const auto jobs = store.jobs();
  std::map<std::int64_t, double> spent;  // by job
  for (const schema::JobRow& row : jobs) spent[row.job_id] = row.progress.cpu_seconds;

  std::vector<FinishedSeries> all;
  for (const schema::JobRow& row : jobs) {
    if (row.job.kind != schema::Kind::cooling || row.status != schema::Status::done) continue;
    const std::string& series = row.series;
    if (!wanted(series)) continue;
    if (all.empty() || schema::series_identity(all.back().job) != series)
      all.push_back({.job = row.job, .runs = {}});
    all.back().runs.push_back(finished_run(store, row));
    if (row.equilibration_id)
      all.back().runs.back().equilibration_cpu_seconds = spent[*row.equilibration_id];
    complete(row, all.back().runs.back());
  }
  return all;
}

}  // namespace

FinishedRun finished_run(const schema::Reader& store, const schema::JobRow& row) {
  FinishedRun run{.seed = row.job.seed,
                  .tau_max = row.tau_max,
                  .cpu_seconds = row.progress.cpu_seconds,
                  .samples = store.samples(row.job_id)};
  // Errors are told from blocks of samples, and from every second sample: at equal intervals.
  std::erase_if(run.samples,
                [&](const auto& sample) { return !is_at_interval(row.job, sample.tau); });
  if (const auto results = store.results(row.job_id)) run.tau_c = results->tau_c;
  return run;
}

std::vector<FinishedSeries> read_finished_runs(const schema::Reader& store) {
  return read_those(
      store, [](const std::string&) { return true; },
      [&](const schema::JobRow& row, FinishedRun& run) { read_correlations(store, row, run); });
}

std::vector<FinishedSeries> read_finished_runs(const schema::Reader& store,
                                               const std::set<std::string>& wanted) {
  return read_those(
      store, [&](const std::string& series) { return wanted.contains(series); },
      [](const schema::JobRow&, FinishedRun&) {});
}

}  // namespace haff::campaign
