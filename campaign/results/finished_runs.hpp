// SPDX-License-Identifier: GPL-3.0-or-later

// Finished runs with their cost, from which accuracy and its price are judged.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::campaign {

// G_parallel of one state from the usual cells of one sigma, and from wider ones.
inline constexpr double wide_cell = 2;  // [sigma]
struct MeshTrial {
  schema::Profile usual, wide;
};

// One finished realization.
struct FinishedRun {
  std::uint64_t seed = 0;
  double tau_max = 0;
  double cpu_seconds = 0;                // of cooling from 0 to tau_max
  double equilibration_cpu_seconds = 0;  // of what it started from, which other e may share
  std::optional<double> tau_c = {};
  std::vector<schema::Sample> samples = {};        // by tau
  std::vector<schema::Profile> correlations = {};  // G_parallel, by tau
  std::optional<MeshTrial> mesh = {};              // where correlations are measured
};

struct FinishedSeries {
  schema::Job job;                // of its first realization
  std::vector<FinishedRun> runs;  // by seed, at least one
};

// A job's run, without its correlations and what its equilibration took.
FinishedRun finished_run(const schema::Reader& store, const schema::JobRow& row);

// All finished cooling jobs, series by series in the order of tables.
std::vector<FinishedSeries> read_finished_runs(const schema::Reader& store);

// Those of these series only, named by schema::series_identity, and without their correlations.
std::vector<FinishedSeries> read_finished_runs(const schema::Reader& store,
                                               const std::set<std::string>& wanted);

}  // namespace haff::campaign
