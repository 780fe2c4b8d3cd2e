// SPDX-License-Identifier: GPL-3.0-or-later

// When clusters appear, measured beside tau_c: said, not judged. Both onsets lie between samples
// that are some way apart: ln of the growing quantity is interpolated linearly between them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/statistics/statistics.hpp"
#include "campaign/paper/claims/claims.hpp"
#include "campaign/paper/figure.hpp"

namespace haff::campaign {
namespace {

constexpr double clustered = 0.01;     // of the particles in the largest cluster
constexpr std::size_t long_waves = 4;  // shells of wave vectors

// First x where the growing y reaches a level. NaN of y are passed over.
std::optional<double> crossing(const std::vector<double>& x, const std::vector<double>& y,
                               double level) {
  std::optional<std::size_t> before;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!(y[i] > 0)) continue;
    if (y[i] >= level && !before) return x[i];
    if (y[i] >= level) {
      const double share = std::log(level / y[*before]) / std::log(y[i] / y[*before]);
      return x[*before] + share * (x[i] - x[*before]);
    }
    before = i;
  }
  return std::nullopt;
}

std::string in_tau_c(const MeanSeries& series, double tau) {
  const auto tau_c = mean_tau_c(series);
  return tau_c ? fmt::format("{:.2f} τ_c", tau / tau_c->tau_c) : std::string();
}

void add_largest_cluster(const MeanSeries& series, Table& table) {
  std::vector<double> onsets;
  for (const Realization& run : series.runs)
    if (const auto onset = crossing(run.tau, run.largest_cluster, clustered))
      onsets.push_back(*onset);
  if (onsets.empty()) return;
  const auto onset = analysis::estimate(onsets);
  table.push_back(
      {.claim = "clusters",
       .quantity = fmt::format("τ when the largest cluster holds {:g} %", 100 * clustered),
       .e = series.e,
       .n = series.n,
       .value = onset.mean,
       .half_interval = half_interval_of(onset),
       .source = "measured",
       .note = in_tau_c(series, onset.mean)});
}

void add_structure(const MeanSeries& series, Table& table) {
  std::vector<double> tau, mean;
  double longest = 0;
  for (const MeanProfile& profile : series.profiles) {
    if (profile.name != "S" || profile.x.size() < long_waves) continue;
    const auto& s = profile.mean.value;
    tau.push_back(profile.tau);
    mean.push_back(analysis::estimate({s.begin(), s.begin() + long_waves}).mean);
    longest = profile.x[long_waves - 1];
  }
  const auto onset = crossing(tau, mean, 1);
  if (!onset) return;
  const std::string relative = in_tau_c(series, *onset);
  table.push_back({.claim = "structure",
                   .quantity = "τ when S(k) of the longest waves exceeds 1",
                   .e = series.e,
                   .n = series.n,
                   .value = *onset,
                   .source = "measured",
                   .note = fmt::format("mean of k ≤ {:.3g}/σ{}{}", longest,
                                       relative.empty() ? "" : "; ", relative)});
}

}  // namespace

void add_clusters(const Averages& averages, Table& table) {
  for (const MeanSeries& series : choose_series(averages, base_density, &MeanSeries::gamma_ratio)) {
    add_largest_cluster(series, table);
    add_structure(series, table);
  }
}

}  // namespace haff::campaign
