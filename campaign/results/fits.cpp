#include "campaign/results/fits.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "analysis/cooling.hpp"
#include "analysis/energy_equation.hpp"
#include "analysis/late_stage.hpp"

namespace haff::campaign {
namespace {

constexpr double late_from = 2.0;   // tau_c: by then the gas is in clusters
constexpr double late_until = 2.5;  // tau_c: a shorter stretch tells no exponent

// Fewer samples than this tell b from no other.
constexpr std::size_t fewest_samples = 10;

std::optional<analysis::Estimate> estimate_of(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return analysis::estimate(values);
}

bool has_temperature(const Realization& run) {
  return std::ranges::all_of(run.temperature, [](double t) { return t > 0; });
}

}  // namespace

std::optional<analysis::Estimate> fitted_cutoff(const MeanSeries& series) {
  std::vector<double> fitted;
  for (const Realization& run : series.runs) {
    if (!has_temperature(run)) continue;
    const auto end = run.tau_c ? std::ranges::upper_bound(run.tau, *run.tau_c) : run.tau.end();
    const auto samples = static_cast<std::size_t>(end - run.tau.begin());
    if (samples < fewest_samples) continue;
    std::vector<double> energy(run.temperature.begin(),
                               run.temperature.begin() + (end - run.tau.begin()));
    for (double& each : energy) each /= analysis::initial_temperature();
    fitted.push_back(analysis::fit_cutoff({.e = series.e, .n = series.n},
                                          std::span(run.tau).first(samples), energy)
                         .b);
  }
  return estimate_of(fitted);
}

std::optional<analysis::Estimate> late_exponent(const MeanSeries& series) {
  std::vector<double> exponents;
  for (const Realization& run : series.runs) {
    if (!has_temperature(run) || !run.tau_c || run.tau.back() < late_until * *run.tau_c) continue;
    exponents.push_back(
        -analysis::late_exponent(run.tau, run.temperature, late_from * *run.tau_c, run.tau.back())
             .exponent);
  }
  return estimate_of(exponents);
}

}  // namespace haff::campaign
