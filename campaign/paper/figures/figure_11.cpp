// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 11: the local decay rate gamma(tau)/gamma_0 in the early stage. It falls below one from
// the start, as the energy equation says, and far more than Enskog-Boltzmann theory allows; of
// that the curve shown is the one that deviates most (e = 0.865).
#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/theory/energy_equation.hpp"
#include "campaign/paper/decay_rates.hpp"
#include "campaign/paper/figure.hpp"
#include "campaign/paper/uncorrelated.hpp"

namespace haff::campaign {
namespace {

constexpr double deepest_a2 = 0.865;  // e of the largest |a_2| above 0.8

// The early stage: until the most dissipative gas shown has lost its homogeneity.
double early(const std::vector<MeanSeries>& chosen) {
  const double crossover =
      analysis::energy_equation_tau_c({.e = chosen.front().e, .n = base_density});
  return std::min(chosen.front().tau.back(), 10 * std::ceil(crossover / 10));
}

}  // namespace

std::optional<Plot> figure_11(const Averages& averages) {
  const auto chosen = choose_series(averages, base_density, &MeanSeries::gamma_ratio);
  if (chosen.empty()) return std::nullopt;
  const double end = early(chosen);

  Panel panel{.x = {.label = "{/:Italic τ}", .column = "tau", .low = 0, .high = end},
              .y = {.label = "{/:Italic γ} / {/:Italic γ}_0", .column = "gamma_ratio"},
              .legend = "bottom left"};
  for (const MeanSeries& series : chosen) {
    Curve curve = decay_rates(series, end);
    curve.colour = colour(panel.curves.size(), chosen.size());
    panel.curves.push_back(std::move(curve));
  }
  for (const auto velocities :
       {analysis::Velocities::enskog_boltzmann, analysis::Velocities::gaussian})
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      panel.curves.push_back(energy_equation_rates(chosen[i].e, base_density, end, velocities));
      panel.curves.back().colour = colour(i, chosen.size());
    }
  for (Curve& entry : energy_equation_entries()) panel.curves.push_back(std::move(entry));
  Curve boltzmann = direct_curve("gamma_ratio", deepest_a2, end).value();  // tabulated
  boltzmann.legend = "Enskog–Boltzmann, {/:Italic e} = 0.865";
  boltzmann.look = Look::dashed;
  panel.curves.push_back(std::move(boltzmann));
  const Range range = y_range(panel.curves);
  panel.y.low = range.low - 0.04 * range.width();
  panel.y.high = range.high + 0.04 * range.width();
  return Plot{
      .panels = {panel},
      .caption = provenance(chosen) + intervals_note() + error_note(chosen) + contact_value_note()};
}

}  // namespace haff::campaign
