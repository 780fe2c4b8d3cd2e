// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 4: how the velocity distribution leaves the Gaussian and returns, a_2, a_3, a_4 against
// tau at e = 0.90, with tau_c marked, beside what a gas without correlations does.
#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "campaign/paper/figure.hpp"
#include "campaign/paper/uncorrelated.hpp"
#include "campaign/plot/reference_line.hpp"

namespace haff::campaign {

std::optional<Plot> figure_04(const Averages& averages) {
  const auto available = choose_series(averages, base_density, &MeanSeries::a2);
  if (available.empty()) return std::nullopt;
  const MeanSeries& series = nearest(available, 0.90);
  const double end = homogeneous_stage(series);

  Panel panel{.x = {.label = "{/:Italic τ}", .column = "tau", .low = 0, .high = end},
              .y = {.label = "{/:Italic a_ℓ}", .column = "coefficient"},
              .legend = "top left horizontal"};
  std::vector<std::optional<Curve>> theories;
  std::size_t coefficients = 0;
  const auto add = [&](const char* name, const char* legend, const Means& means) {
    Curve curve = measured_curve(series);
    curve.name = name;
    curve.legend = legend;
    curve.x = series.tau;
    curve.y = means.value;
    curve.error = means.error;
    curve.colour = colour(coefficients++, 3);
    curve.width = 1.3;
    theories.push_back(direct_curve(name, series.e, end));
    if (theories.back()) {
      theories.back()->colour = curve.colour;
      theories.back()->look = Look::dashed;
      theories.back()->legend = "";
    }
    panel.curves.push_back(until(end, std::move(curve)));
  };
  add("a2", "{/:Italic a}_2", series.a2);
  add("a3", "{/:Italic a}_3", series.a3);
  add("a4", "{/:Italic a}_4", series.a4);
  for (auto& theory : theories)
    if (theory) panel.curves.push_back(std::move(*theory));
  if (panel.curves.size() > coefficients)
    panel.curves.push_back({.legend = "Enskog–Boltzmann", .look = Look::dashed});
  // Room for the legend above all curves.
  const Range range = y_range(panel.curves);
  panel.y.low = range.low - 0.05 * range.width();
  panel.y.high = range.high + 0.2 * range.width();
  panel.commands.push_back(reference_line(0));

  for (const MeanTauC& each : choose_tau_c(averages, base_density)) {
    if (each.e != series.e || each.tau_c > end) continue;
    panel.commands.push_back(fmt::format(
        "set arrow from first {0}, graph 0 to first {0}, graph 0.84 nohead back lw 1 dt (4,4)",
        each.tau_c));
    panel.commands.push_back(
        fmt::format("set label '{{/:Italic τ}}_c' at first {}, graph 0.79 offset character 0.6, 0",
                    each.tau_c));
  }
  return Plot{.panels = {panel},
              .caption = provenance({series}) + coefficient_error_note({series})};
}

}  // namespace haff::campaign
