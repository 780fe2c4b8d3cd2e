// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 6: a_2 at short times for several densities at e = 0.85, beside Enskog-Boltzmann theory,
// which is the same for all. The denser the gas, the sooner its correlations turn a_2 back.
#include <algorithm>
#include <utility>

#include "campaign/base/text/number_text.hpp"
#include "campaign/paper/figure.hpp"
#include "campaign/paper/uncorrelated.hpp"

namespace haff::campaign {
namespace {

constexpr double short_until = 30;

}  // namespace

std::optional<Plot> figure_06(const Averages& averages) {
  const auto chosen = choose_densities(averages, densities_restitution, &MeanSeries::a2);
  if (chosen.empty()) return std::nullopt;
  double end = 0;
  for (const MeanSeries& series : chosen) end = std::max(end, series.tau.back());
  end = std::min(end, short_until);

  Panel panel{.x = {.label = "{/:Italic τ}", .column = "tau", .low = 0, .high = end},
              .y = {.label = "{/:Italic a}_2", .column = "a2"},
              .legend = "top right horizontal maxcols 2"};
  for (const MeanSeries& series : chosen) {
    Curve curve = measured_curve(series);
    curve.name = "n = " + density_text(series.n);
    curve.legend = "{/:Italic n} = " + density_text(series.n);
    curve.colour = shade(panel.curves.size(), chosen.size());
    curve.width = 1.5;
    curve.x = series.tau;
    curve.y = series.a2.value;
    curve.error = series.a2.error;
    panel.curves.push_back(until(end, std::move(curve)));
  }
  if (auto direct = direct_curve("a2", densities_restitution, end))
    panel.curves.push_back(std::move(*direct));
  panel.curves.push_back(first_order_curve("a2", densities_restitution, end));
  // Room for the legend above all curves.
  const Range range = y_range(panel.curves);
  panel.y.low = range.low - 0.05 * range.width();
  panel.y.high = range.high + 0.3 * range.width();
  return Plot{.panels = {panel}, .caption = provenance(chosen) + coefficient_error_note(chosen)};
}

}  // namespace haff::campaign
