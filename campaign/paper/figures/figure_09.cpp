// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 9: velocity correlations along and across the separation at tau = 50, e = 0.80, beside
// the theory of an incompressible fluid.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "analysis/theory/cooling.hpp"
#include "analysis/theory/correlations.hpp"
#include "campaign/paper/figure.hpp"
#include "campaign/plot/reference_line.hpp"

namespace haff::campaign {
namespace {

constexpr double moment = 50;    // tau
constexpr double unit = 1e-3;    // of G m / T_0 on the axis
constexpr double farthest = 40;  // r [sigma] that is shown

Curve measured(const MeanSeries& series, const MeanProfile& profile, double end) {
  Curve curve = measured_curve(series);
  curve.name = profile.name;
  curve.x = profile.x;
  for (std::size_t i = 0; i < profile.x.size(); ++i) {
    curve.y.push_back(profile.mean.value[i] / (unit * analysis::initial_temperature()));
    curve.error.push_back(profile.mean.error[i] / (unit * analysis::initial_temperature()));
  }
  curve.realizations.assign(curve.x.size(), profile.realizations);
  curve.look = Look::symbols;
  return until(end, std::move(curve));
}

Curve theory(const MeanSeries& series, double tau, double end,
             double analysis::VelocityCorrelation::*part) {
  Curve curve{.source = Source::theory, .e = series.e, .n = series.n};
  constexpr int points = 160;
  for (int i = 1; i <= points; ++i) {
    const double r = end * i / points;
    const auto correlation = analysis::velocity_correlation({.e = series.e, .n = series.n}, r, tau,
                                                            analysis::Fluid::incompressible);
    curve.x.push_back(r);
    curve.y.push_back(correlation.*part / (unit * analysis::initial_temperature()));
  }
  return curve;
}

}  // namespace

std::optional<Plot> figure_09(const Averages& averages) {
  const auto available = choose_profiles(averages, base_density, "G_parallel");
  if (available.empty()) return std::nullopt;
  const MeanSeries& series = nearest(available, correlations_restitution);
  const MeanProfile* parallel = series.profile("G_parallel", moment);
  const MeanProfile* perpendicular = series.profile("G_perpendicular", parallel->tau);
  if (parallel->tau <= 0 || perpendicular == nullptr) return std::nullopt;
  const double end = std::min(farthest, parallel->x.back());

  Panel panel{.x = {.label = "{/:Italic r} / {/:Italic σ}", .column = "r", .low = 0, .high = end},
              .y = {.label = "10^3 {/:Italic G m} / {/:Italic T}_0", .column = "G_times_1000"}};
  panel.curves.push_back(measured(series, *parallel, end));
  panel.curves.back().legend = "{/:Italic G}_{∥}";
  panel.curves.push_back(measured(series, *perpendicular, end));
  panel.curves.back().legend = "{/:Italic G}_{⊥}";
  const Range range = y_range(panel.curves);
  panel.curves.push_back(
      theory(series, parallel->tau, end, &analysis::VelocityCorrelation::parallel));
  panel.curves.back().name = "G_parallel, incompressible";
  panel.curves.push_back(
      theory(series, parallel->tau, end, &analysis::VelocityCorrelation::perpendicular));
  panel.curves.back().name = "G_perpendicular, incompressible";
  for (std::size_t i = 0; i < panel.curves.size(); ++i) panel.curves[i].colour = colour(i % 2, 2);
  panel.curves.push_back({.legend = "incompressible theory"});
  panel.commands.push_back(reference_line(0));
  panel.y.low = range.low - 0.1 * range.width();
  panel.y.high = range.high + 0.1 * range.width();
  return Plot{.panels = {panel},
              .caption = fmt::format("τ = {:g}. ", parallel->tau) + provenance({series}) +
                         error_note({series}) + contact_value_note()};
}

}  // namespace haff::campaign
