// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 10: velocity correlations at e = 0.80 for 20 <= tau <= 60, with lengths measured in
// sigma sqrt(tau) and G in T_0 / (m tau^(d/2)): were it for the diffusion of vorticity alone, they
// would fall on one curve. Beside them the theory of an incompressible fluid at the first and the
// last tau, which does not quite do so either.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/theory/cooling.hpp"
#include "analysis/theory/correlations.hpp"
#include "campaign/paper/figure.hpp"
#include "campaign/plot/reference_line.hpp"

namespace haff::campaign {
namespace {

constexpr double farthest_scaled = 6;  // r / (sigma sqrt(tau)) that is shown

Curve scaled(const MeanSeries& series, const MeanProfile& profile) {
  Curve curve = measured_curve(series);
  curve.name = fmt::format("{}, tau = {:g}", profile.name, profile.tau);
  const double scale = std::pow(profile.tau, 1.5) / analysis::initial_temperature();
  for (std::size_t i = 0; i < profile.x.size(); ++i) {
    curve.x.push_back(profile.x[i] / std::sqrt(profile.tau));
    curve.y.push_back(profile.mean.value[i] * scale);
    curve.error.push_back(profile.mean.error[i] * scale);
  }
  curve.realizations.assign(curve.x.size(), profile.realizations);
  curve.look = Look::symbols;
  return curve;
}

// What the theory of an incompressible fluid has at this tau.
Curve theory(const MeanSeries& series, const ScaledCorrelation& measured, const char* name,
             double analysis::VelocityCorrelation::*part, double end) {
  Curve curve{.name = fmt::format("{}, incompressible, tau = {:g}", name, measured.tau),
              .source = Source::theory,
              .e = series.e,
              .n = series.n};
  curve.colour = measured.curve.colour;
  curve.width = 1.2;
  constexpr int points = 120;
  for (int i = 1; i <= points; ++i) {
    const double x = end * i / points;
    const auto correlation =
        analysis::velocity_correlation({.e = series.e, .n = series.n}, x * std::sqrt(measured.tau),
                                       measured.tau, analysis::Fluid::incompressible);
    curve.x.push_back(x);
    curve.y.push_back(correlation.*part * std::pow(measured.tau, 1.5) /
                      analysis::initial_temperature());
  }
  return curve;
}

}  // namespace

std::vector<ScaledCorrelation> scaled_correlations(const MeanSeries& series,
                                                   const std::string& name) {
  std::vector<ScaledCorrelation> curves;
  for (const MeanProfile& profile : series.profiles) {
    if (profile.name != name || profile.tau < scaling_from || profile.tau > scaling_until) continue;
    curves.push_back({.tau = profile.tau, .curve = scaled(series, profile)});
    curves.back().curve.legend = fmt::format("{{/:Italic τ}} = {:g}", profile.tau);
  }
  for (std::size_t i = 0; i < curves.size(); ++i) curves[i].curve.colour = shade(i, curves.size());
  return curves;
}

std::optional<Plot> figure_10(const Averages& averages) {
  const auto available = choose_profiles(averages, base_density, "G_parallel");
  if (available.empty()) return std::nullopt;
  const MeanSeries& series = nearest(available, correlations_restitution);

  const auto parallel = scaled_correlations(series, "G_parallel");
  const auto perpendicular = scaled_correlations(series, "G_perpendicular");
  if (parallel.size() < 2) return std::nullopt;

  double end = 0;
  for (const auto& each : parallel) end = std::max(end, each.curve.x.back());
  end = std::min(end, farthest_scaled);
  Panel panel{
      .x = {.label = "{/:Italic r} / ({/:Italic σ} {/:Italic τ}^{ 1/2})",
            .column = "r_scaled",
            .low = 0,
            .high = end},
      .y = {.label = "{/:Italic G τ}^{3/2} {/:Italic m} / {/:Italic T}_0", .column = "G_scaled"}};
  for (const auto& each : parallel) panel.curves.push_back(until(farthest_scaled, each.curve));
  for (const auto& each : perpendicular) {
    panel.curves.push_back(until(farthest_scaled, each.curve));
    panel.curves.back().symbol = 6;
    panel.curves.back().legend = "";
  }
  const Range range = y_range(panel.curves);
  for (const ScaledCorrelation* each : {&parallel.front(), &parallel.back()}) {
    panel.curves.push_back(
        theory(series, *each, "G_parallel", &analysis::VelocityCorrelation::parallel, end));
    panel.curves.push_back(theory(series, *each, "G_perpendicular",
                                  &analysis::VelocityCorrelation::perpendicular, end));
  }
  panel.curves.push_back(
      {.legend = fmt::format("incompressible theory, {{/:Italic τ}} = {:g} and {:g}",
                             parallel.front().tau, parallel.back().tau),
       .width = 1.2});
  Curve key{.legend = "{/:Italic G}_{∥}", .look = Look::symbols};
  panel.curves.push_back(key);
  key.legend = "{/:Italic G}_{⊥}";
  key.symbol = 6;
  panel.curves.push_back(key);
  panel.commands.push_back(reference_line(0));
  panel.y.low = range.low - 0.05 * range.width();
  panel.y.high = range.high + 0.05 * range.width();
  return Plot{.panels = {panel},
              .caption = provenance({series}) + error_note({series}) + contact_value_note()};
}

}  // namespace haff::campaign
