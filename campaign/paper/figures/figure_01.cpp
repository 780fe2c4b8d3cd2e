// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 1: how the temperature decays, T(tau)/T_0 against 2 gamma_0 tau, beside Haff's law. On
// this axis Haff's law is one line for every e; the circles mark tau_c, where T is twice that.
#include <algorithm>
#include <cmath>

#include "analysis/theory/cooling.hpp"
#include "campaign/paper/figure.hpp"

namespace haff::campaign {

std::optional<Plot> figure_01(const Averages& averages) {
  const auto chosen = choose_series(averages, base_density, &MeanSeries::temperature);
  if (chosen.empty()) return std::nullopt;

  Panel panel{.x = {.label = "2{/:Italic γ}_0{/:Italic τ}", .column = "two_gamma0_tau", .low = 0},
              .y = {.label = "{/:Italic T} / {/:Italic T}_0",
                    .column = "temperature_ratio",
                    .logarithmic = true,
                    .high = 1,
                    .tics = "format '10^{%T}'"}};
  double longest = 0;
  for (const MeanSeries& series : chosen) {
    Curve curve = measured_curve(series);
    for (std::size_t i = 0; i < series.tau.size(); ++i) {
      curve.x.push_back(2 * analysis::gamma0(series.e) * series.tau[i]);
      curve.y.push_back(series.temperature.value[i] / analysis::initial_temperature());
      curve.error.push_back(series.temperature.error[i] / analysis::initial_temperature());
    }
    curve.colour = colour(panel.curves.size(), chosen.size());
    longest = std::max(longest, curve.x.back());
    panel.curves.push_back(std::move(curve));
  }

  // The range is the gas's: Haff's law soon leaves it.
  panel.x.high = longest;
  panel.y.low = decade_below(y_range(panel.curves, true).low);

  Curve haff{.name = "Haff", .legend = "Haff's law", .source = Source::theory};
  haff.look = Look::dashed;
  haff.x = {0, longest};
  haff.y = {1, std::exp(-longest)};
  panel.curves.push_back(haff);

  Curve crossover{.name = "tau_c", .legend = "{/:Italic τ}_c", .source = Source::measured};
  crossover.look = Look::symbols;
  crossover.symbol = 6;
  crossover.size = 0.9;
  for (const MeanTauC& each : choose_tau_c(averages, base_density)) {
    const double x = 2 * analysis::gamma0(each.e) * each.tau_c;
    crossover.x.push_back(x);
    crossover.y.push_back(2 * std::exp(-x));
    crossover.realizations.push_back(each.reached);
  }
  if (!crossover.x.empty()) panel.curves.push_back(crossover);

  return Plot{.panels = {panel}, .caption = provenance(chosen) + error_note(chosen)};
}

}  // namespace haff::campaign
