// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 5: a_2 at e = 0.90 beside Enskog-Boltzmann theory, which knows no correlations: the gas
// follows it for a few collisions per particle only (inset), then turns back.
#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "campaign/paper/figure.hpp"
#include "campaign/paper/uncorrelated.hpp"

namespace haff::campaign {
namespace {

constexpr double short_times = 15;  // the inset's end: the theory is on its plateau by then

// The theory's curves, where both are known: to first order, as the paper has it, and all of it.
std::vector<Curve> theories(double e, double end) {
  std::vector<Curve> curves;
  if (auto direct = direct_curve("a2", e, end)) curves.push_back(std::move(*direct));
  curves.push_back(first_order_curve("a2", e, end));
  if (curves.size() == 1) curves.back().legend = "Enskog–Boltzmann, first order in {/:Italic a}_2";
  return curves;
}

Curve simulation(const MeanSeries& series, double end) {
  Curve curve = measured_curve(series);
  curve.legend = "simulation, " + curve.legend;
  curve.colour = colour(0, 2);
  curve.width = 1.3;
  curve.x = series.tau;
  curve.y = series.a2.value;
  curve.error = series.a2.error;
  return until(end, std::move(curve));
}

}  // namespace

std::optional<Plot> figure_05(const Averages& averages) {
  const auto available = choose_series(averages, base_density, &MeanSeries::a2);
  if (available.empty()) return std::nullopt;
  const MeanSeries& series = nearest(available, 0.90);
  const double end = homogeneous_stage(series);
  const double start = std::min(short_times, end);

  Panel whole{.x = {.label = "{/:Italic τ}", .column = "tau", .low = 0, .high = end},
              .y = {.label = "{/:Italic a}_2", .column = "a2"},
              .curves = {simulation(series, end)},
              .legend = "bottom right"};
  for (Curve& curve : theories(series.e, end)) whole.curves.push_back(std::move(curve));
  // Room for the inset above all curves, and for the legend below.
  const Range range = y_range(whole.curves);
  whole.y.low = range.low - 0.6 * range.width();
  whole.y.high = range.high + 1.25 * range.width();

  Panel inset{.name = "inset",
              .x = {.column = "tau", .low = 0, .high = start},
              .y = {.column = "a2"},
              .curves = theories(series.e, start),
              .legend = "none",
              .small = true,
              .frame = {{0.42, 0.94, 0.675, 0.95}}};
  inset.curves.push_back(simulation(series, start));
  inset.curves.back().look = Look::symbols;
  const Range inner = y_range(inset.curves);
  inset.y.tics = fmt::format("{:g}", round_step(inner.width() / 4));
  inset.y.low = inner.low - 0.1 * inner.width();
  inset.y.high = inner.high + 0.1 * inner.width();
  return Plot{.panels = {whole, inset},
              .caption = provenance({series}) + coefficient_error_note({series})};
}

}  // namespace haff::campaign
