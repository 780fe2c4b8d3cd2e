// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 12: the local decay rate gamma(tau)/gamma_0 for several densities at e = 0.85. The energy
// equation depends on n through the correlations; Enskog-Boltzmann theory does not.
#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/theory/energy_equation.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/paper/decay_rates.hpp"
#include "campaign/paper/figure.hpp"
#include "campaign/paper/uncorrelated.hpp"

namespace haff::campaign {
namespace {

Curve boltzmann(double end) {
  Curve curve = direct_curve("gamma_ratio", densities_restitution, end).value();  // tabulated
  curve.look = Look::dashed;
  return curve;
}

// The same again where curves of dilute gases lie, which differ by less than a hundredth.
Panel dilute(Panel panel) {
  constexpr double densest = 0.2;
  std::erase_if(panel.curves, [](const Curve& curve) {
    return curve.x.empty() || (curve.n && *curve.n > densest);
  });
  for (Curve& curve : panel.curves) curve.legend = "";
  panel.name = "dilute";
  panel.legend = "none";
  panel.y.low = 0.96;
  panel.y.high = 1.002;
  panel.y.tics = "0.01";
  panel.frame = {{0.59, 0.98, 0.215, 0.975}};
  panel.commands = {"set label '{/:Italic n} ≤ 0.2' at graph 0.05, graph 0.08"};
  return panel;
}

}  // namespace

std::optional<Plot> figure_12(const Averages& averages) {
  const auto chosen = choose_densities(averages, densities_restitution, &MeanSeries::gamma_ratio);
  if (chosen.empty()) return std::nullopt;
  // The early stage: until the densest gas has lost its homogeneity.
  const double crossover =
      analysis::energy_equation_tau_c({.e = densities_restitution, .n = chosen.back().n});
  const double end = std::min(chosen.back().tau.back(), 10 * std::ceil(crossover / 10));

  Panel panel{.x = {.label = "{/:Italic τ}", .column = "tau", .low = 0, .high = end},
              .y = {.label = "{/:Italic γ} / {/:Italic γ}_0", .column = "gamma_ratio"},
              .legend = "bottom left"};
  std::vector<Curve> theories;
  for (const MeanSeries& series : chosen) {
    Curve curve = decay_rates(series, end);
    curve.name = "n = " + density_text(series.n);
    curve.legend = "{/:Italic n} = " + density_text(series.n);
    curve.colour = shade(panel.curves.size(), chosen.size());
    for (const auto velocities :
         {analysis::Velocities::enskog_boltzmann, analysis::Velocities::gaussian}) {
      theories.push_back(energy_equation_rates(densities_restitution, series.n, end, velocities));
      theories.back().colour = curve.colour;
    }
    panel.curves.push_back(std::move(curve));
  }
  panel.curves.insert(panel.curves.end(), theories.begin(), theories.end());
  for (Curve& entry : energy_equation_entries()) panel.curves.push_back(std::move(entry));
  panel.curves.push_back(boltzmann(end));
  const Range range = y_range(panel.curves);
  panel.y.low = range.low - 0.04 * range.width();
  panel.y.high = range.high + 0.04 * range.width();
  panel.frame = {{0.09, 0.50, 0.215, 0.975}};
  return Plot{
      .panels = {panel, dilute(panel)},
      .caption = provenance(chosen) + intervals_note() + error_note(chosen) + contact_value_note(),
      .width = 960};
}

}  // namespace haff::campaign
