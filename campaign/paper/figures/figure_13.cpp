// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 13: what velocity correlations add to the energy, E - E_Haff against tau, beside the
// energy equation. Where a curve crosses its own E_Haff (dotted), E is twice Haff's: tau_c.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/theory/cooling.hpp"
#include "analysis/theory/energy_equation.hpp"
#include "campaign/paper/figure.hpp"

namespace haff::campaign {
namespace {

constexpr double half_d = 1.5;  // E = (d/2) T

Curve simulation(const MeanSeries& series) {
  Curve curve = measured_curve(series);
  curve.name = "E - E_Haff";
  for (std::size_t i = 0; i < series.tau.size(); ++i) {
    const double haff = analysis::haff_temperature(series.tau[i], series.e);
    curve.x.push_back(series.tau[i]);
    curve.y.push_back(half_d * (series.temperature.value[i] - haff));
    curve.error.push_back(half_d * series.temperature.error[i]);
  }
  curve.look = Look::symbols;
  return curve;
}

// From the first collision on: before, the excess is too small for a logarithmic axis.
std::vector<analysis::EnergyPoint> solution(const MeanSeries& series) {
  constexpr int steps = 300;
  std::vector<double> tau;
  for (int i = 0; i <= steps; ++i) tau.push_back(1 + (series.tau.back() - 1) * i / steps);
  return analysis::energy_equation({.e = series.e, .n = series.n}, tau);
}

Curve theory(const MeanSeries& series) {
  Curve curve{.name = "E - E_Haff, energy equation",
              .source = Source::theory,
              .e = series.e,
              .n = series.n};
  for (const auto& point : solution(series)) {
    curve.x.push_back(point.tau);
    curve.y.push_back(point.energy - point.haff);
  }
  return curve;
}

Curve haff(const MeanSeries& series) {
  Curve curve{.name = "E_Haff", .source = Source::theory, .e = series.e};
  curve.look = Look::dotted;
  for (const auto& point : solution(series)) {
    curve.x.push_back(point.tau);
    curve.y.push_back(point.haff);
  }
  return curve;
}

}  // namespace

std::optional<Plot> figure_13(const Averages& averages) {
  auto chosen = choose_series(averages, base_density, &MeanSeries::temperature);
  std::erase_if(chosen, [](const MeanSeries& s) { return s.tau.back() <= 1; });
  if (chosen.empty()) return std::nullopt;

  std::vector<Curve> lines, measured, theories;
  double end = 0;
  for (const MeanSeries& series : chosen) {
    const std::string shade = colour(lines.size(), chosen.size());
    lines.push_back(haff(series));
    measured.push_back(simulation(series));
    theories.push_back(theory(series));
    lines.back().colour = measured.back().colour = theories.back().colour = shade;
    end = std::max(end, series.tau.back());
  }
  // The range is the excess's: Haff's law soon leaves it, unless the series are short.
  const double low = decade_below(y_range(theories, true).low);
  const bool crosses = y_range(lines, true).low < 0.1;
  Panel panel{.x = {.label = "{/:Italic τ}", .column = "tau", .low = 0, .high = end},
              .y = {.label = "{/:Italic E} − {/:Italic E}_{Haff}",
                    .column = "energy",
                    .logarithmic = true,
                    .low = low,
                    .high = 1,
                    .tics = "format '10^{%T}'"},
              .legend = crosses ? "top right" : "bottom right"};
  for (const auto& group : {lines, measured, theories}) {
    panel.curves.insert(panel.curves.end(), group.begin(), group.end());
  }
  panel.curves.push_back(
      {.legend = fmt::format("energy equation, {{/:Italic b}} = {:.2f}", analysis::cutoff_b)});
  panel.curves.push_back({.legend = "{/:Italic E}_{Haff}", .look = Look::dotted});
  return Plot{.panels = {panel},
              .caption = provenance(chosen) + error_note(chosen) + contact_value_note()};
}

}  // namespace haff::campaign
