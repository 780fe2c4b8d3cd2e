// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/paper/decay_rates.hpp"

#include <fmt/format.h>

#include "campaign/paper/measured_curve.hpp"

namespace haff::campaign {
namespace {

constexpr Intervals of_noisy_rates{.from = 4, .width = 3};

std::vector<double> times(double end) {
  constexpr int points = 200;
  std::vector<double> tau;
  for (int i = 0; i <= points; ++i) tau.push_back(end * i / points);
  return tau;
}

}  // namespace

Curve decay_rates(const MeanSeries& series, double end) {
  Curve curve = measured_curve(series);
  curve.realizations.clear();
  add_interval_means(series, RunValue::gamma_ratio, of_noisy_rates, end, curve);
  curve.look = Look::symbols;
  return curve;
}

std::string intervals_note() {
  return fmt::format(" From τ = {:g} on, means over Δτ = {:g}.", of_noisy_rates.from,
                     of_noisy_rates.width);
}

Curve energy_equation_rates(double e, double n, double end, analysis::Velocities velocities) {
  const bool gaussian = velocities == analysis::Velocities::gaussian;
  Curve curve{.name = gaussian ? "energy equation, Gaussian velocities"
                               : "energy equation, Enskog-Boltzmann velocities",
              .source = Source::theory,
              .e = e,
              .n = n,
              .look = gaussian ? Look::dotted : Look::line};
  if (gaussian) curve.width = 1.2;
  for (const auto& point :
       analysis::energy_equation({.e = e, .n = n}, times(end), analysis::cutoff_b, velocities)) {
    curve.x.push_back(point.tau);
    curve.y.push_back(point.gamma_ratio);
  }
  return curve;
}

std::vector<Curve> energy_equation_entries() {
  return {{.legend = fmt::format("energy equation, {{/:Italic b}} = {:.2f}", analysis::cutoff_b)},
          {.legend = "the same, Gaussian velocities", .look = Look::dotted, .width = 1.2}};
}

}  // namespace haff::campaign
