// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/results/fits.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

#include "analysis/statistics/late_stage.hpp"
#include "analysis/theory/cooling.hpp"
#include "analysis/theory/energy_equation.hpp"

namespace haff::campaign {
namespace {

constexpr double late_from = 2.0;   // tau_c: by then the gas is in clusters
constexpr double late_until = 2.5;  // tau_c: a shorter stretch tells no exponent

// Fewer samples than this tell b from no other.
constexpr std::size_t fewest_samples = 10;

// What each realization gives; those that a fit cannot take are left out, and the others stay.
template <class Fit>
std::optional<analysis::Estimate> over_realizations(const MeanSeries& series, Fit&& fit) {
  std::vector<double> values;
  for (const Realization& run : series.runs) {
    try {
      if (const std::optional<double> value = fit(run)) values.push_back(*value);
    } catch (const std::runtime_error&) {     // did not converge
    } catch (const std::invalid_argument&) {  // energies that no gas has
    }
  }
  if (values.empty()) return std::nullopt;
  return analysis::estimate(values);
}

bool has_temperature(const Realization& run) {
  return std::ranges::all_of(run.temperature, [](double t) { return t > 0; });
}

// The exponent within a part of the late stage, in shares of its ln tau.
std::optional<analysis::Estimate> exponent_within(const MeanSeries& series, double from,
                                                  double to) {
  return over_realizations(series, [&](const Realization& run) -> std::optional<double> {
    if (!has_temperature(run) || !run.tau_c || run.tau.back() < late_until * *run.tau_c)
      return std::nullopt;
    const double begin = late_from * *run.tau_c, end = run.tau.back();
    const auto at = [&](double share) { return begin * std::pow(end / begin, share); };
    return -analysis::late_exponent(run.tau, run.temperature, at(from), at(to)).exponent;
  });
}

}  // namespace

std::optional<analysis::Estimate> fitted_cutoff(const MeanSeries& series) {
  return over_realizations(series, [&](const Realization& run) -> std::optional<double> {
    if (!has_temperature(run)) return std::nullopt;
    const auto end = run.tau_c ? std::ranges::upper_bound(run.tau, *run.tau_c) : run.tau.end();
    const auto samples = static_cast<std::size_t>(end - run.tau.begin());
    if (samples < fewest_samples) return std::nullopt;
    std::vector<double> energy(run.temperature.begin(),
                               run.temperature.begin() + (end - run.tau.begin()));
    for (double& each : energy) each /= analysis::initial_temperature();
    return analysis::fit_cutoff({.e = series.e, .n = series.n}, std::span(run.tau).first(samples),
                                energy, {}, analysis::Velocities::enskog_boltzmann)
        .b;
  });
}

std::optional<analysis::Estimate> late_exponent(const MeanSeries& series) {
  return exponent_within(series, 0, 1);
}

std::vector<analysis::Estimate> late_local_exponents(const MeanSeries& series) {
  constexpr int parts = 3;
  std::vector<analysis::Estimate> local;
  for (int k = 0; k < parts; ++k)
    if (const auto slope = exponent_within(series, double(k) / parts, double(k + 1) / parts))
      local.push_back(*slope);
  return local;
}

}  // namespace haff::campaign
