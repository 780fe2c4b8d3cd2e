// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 15, not of the paper: boxes below and above the smallest one that holds a vortex,
// L_c = 2 pi xi_perp. Below, gamma/gamma_0 stays constant for ever, some per cent below one, since
// short waves are correlated there, too; above, the shear mode of wave number 2 pi/L outlives
// everything else. Its energy falls as exp(-2 nu k^2 t), and gamma/gamma_0
// tends to (L_c/L)^2. S. McNamara and W. R. Young, Phys. Rev. E 53, 5089 (1996); lengths:
// analysis/theory/enskog.hpp. A validation of hydrodynamics without any fitted number.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "analysis/theory/cooling.hpp"
#include "analysis/theory/enskog.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/paper/figure.hpp"
#include "engine/initial.hpp"

namespace haff::campaign {
namespace {

constexpr double smallest_box = 0.5, largest_box = 2;  // L/L_c of what is shown
constexpr double shortest_series = 200;                // tau
constexpr double interval = 50;                        // tau that a slope is taken over
constexpr double late_part = 0.25;                     // of the series, for the last slope

using Boxes = std::vector<const MeanSeries*>;

double relative_box(const MeanSeries& series) {
  const double critical =
      2 * std::numbers::pi * analysis::lengths({.e = series.e, .n = series.n}).transverse;
  return engine::box_side(series.n, static_cast<std::uint32_t>(series.particles), 3) / critical;
}

// The gas of which there are most boxes, small ones first; nothing unless they lie on both sides.
Boxes chosen(const Averages& averages) {
  std::map<std::pair<double, double>, Boxes> gases;
  for (const MeanSeries& series : averages.series) {
    if (series.e >= 1 || series.tau.back() < shortest_series) continue;
    if (relative_box(series) < smallest_box || relative_box(series) > largest_box) continue;
    Boxes& boxes = gases[{series.e, series.n}];
    if (boxes.empty() || boxes.back()->particles != series.particles) boxes.push_back(&series);
  }
  Boxes most;
  for (auto& [gas, boxes] : gases) {
    std::ranges::sort(boxes, {}, &MeanSeries::particles);
    const bool both = relative_box(*boxes.front()) < 1 && relative_box(*boxes.back()) > 1;
    if (both && boxes.size() > most.size()) most = boxes;
  }
  return most;
}

// gamma/gamma_0 between two samples from the slope of ln T, over the realizations that have both.
analysis::Estimate slope(const MeanSeries& series, std::size_t from, std::size_t to) {
  std::vector<double> ratios;
  for (const Realization& run : series.runs)
    if (to < run.tau.size())
      ratios.push_back(analysis::gamma_ratio(run.temperature[from], run.temperature[to],
                                             run.tau[to] - run.tau[from], series.e));
  return analysis::estimate(ratios);
}

void add(const analysis::Estimate& mean, double x, Curve& curve) {
  const auto count = static_cast<std::int64_t>(mean.count);
  curve.x.push_back(x);
  curve.y.push_back(mean.mean);
  curve.error.push_back(bar(mean.standard_error, count));
  curve.realizations.push_back(count);
}

Curve against_tau(const MeanSeries& series) {
  Curve curve = measured_curve(series);
  curve.name = fmt::format("N = {}", series.particles);
  curve.legend = fmt::format("{{/:Italic N}} = {}", count_text(series.particles));
  curve.realizations.clear();
  curve.look = Look::symbols;
  for (std::size_t i = 0, k = 0; k < series.tau.size(); ++k) {
    if (series.tau[k] < series.tau[i] + interval) continue;
    add(slope(series, i, k), 0.5 * (series.tau[i] + series.tau[k]), curve);
    i = k;
  }
  return curve;
}

Curve limit(const MeanSeries& series, double end) {
  Curve curve{.name = fmt::format("(L_c/L)^2, N = {}", series.particles),
              .source = Source::theory,
              .e = series.e,
              .n = series.n,
              .particles = series.particles,
              .x = {0, end},
              .look = Look::dashed,
              .width = 1.2};
  curve.y.assign(2, std::min(1.0, std::pow(relative_box(series), -2)));
  return curve;
}

Panel time_panel(const Boxes& boxes) {
  double end = 0;
  for (const MeanSeries* each : boxes) end = std::max(end, each->tau.back());
  Panel panel{.name = "time",
              .x = {.label = "{/:Italic τ}", .column = "x", .low = 0, .high = end},
              .y = {.label = "{/:Italic γ} / {/:Italic γ}_0", .column = "gamma_ratio"},
              .legend = "bottom left"};
  for (const MeanSeries* each : boxes) {
    panel.curves.push_back(against_tau(*each));
    panel.curves.back().colour = colour(panel.curves.size() - 1, boxes.size());
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (relative_box(*boxes[i]) <= 1) continue;
    panel.curves.push_back(limit(*boxes[i], end));
    panel.curves.back().colour = colour(i, boxes.size());
  }
  return panel;
}

Panel box_panel(const Boxes& boxes) {
  Curve measured = measured_curve(*boxes.front());
  measured.name = "late";
  measured.legend = "late in the run";
  measured.particles.reset();
  measured.realizations.clear();
  measured.look = Look::symbols;
  measured.size = 0.9;
  for (const MeanSeries* each : boxes) {
    const double from = (1 - late_part) * each->tau.back();
    const auto first = std::ranges::lower_bound(each->tau, from) - each->tau.begin();
    add(slope(*each, static_cast<std::size_t>(first), each->tau.size() - 1), relative_box(*each),
        measured);
  }
  Curve theory{.name = "(L_c/L)^2",
               .legend = "({/:Italic L}_c/{/:Italic L})^2",
               .source = Source::theory,
               .e = boxes.front()->e,
               .n = boxes.front()->n};
  const double last = 1.05 * relative_box(*boxes.back());
  constexpr int points = 60;
  theory.x.push_back(0.95 * relative_box(*boxes.front()));
  theory.y.push_back(1);
  for (int i = 0; i <= points; ++i) {
    const double box = 1 + (last - 1) * i / points;
    theory.x.push_back(box);
    theory.y.push_back(1 / (box * box));
  }
  return {.name = "box",
          .x = {.label = "{/:Italic L} / {/:Italic L}_c",
                .column = "x",
                .low = theory.x.front(),
                .high = last},
          .y = {.label = "{/:Italic γ} / {/:Italic γ}_0", .column = "gamma_ratio"},
          .curves = {measured, theory},
          .legend = "bottom left"};
}

}  // namespace

std::optional<Plot> figure_15(const Averages& averages) {
  const Boxes boxes = chosen(averages);
  if (boxes.empty()) return std::nullopt;
  Panel time = time_panel(boxes), box = box_panel(boxes);
  time.y.low = box.y.low = 0.5;
  time.y.high = box.y.high = 1.05;
  time.frame = {{0.09, 0.50, 0.215, 0.96}};
  box.frame = {{0.59, 0.98, 0.215, 0.96}};
  std::vector<MeanSeries> series;
  for (const MeanSeries* each : boxes) series.push_back(*each);
  const double critical =
      2 * std::numbers::pi *
      analysis::lengths({.e = series.front().e, .n = series.front().n}).transverse;
  const MeanSeries& gas = series.front();
  return Plot{
      .panels = {time, box},
      .caption =
          fmt::format(
              "e = {}, n = {}, mean of {} realizations. Slopes of ln T over Δτ = {:g}; right, "
              "over the last quarter. L_c = 2πξ⊥ = {:.2f} σ, N = {:.0f}.{}{}",
              restitution_text(gas.e), density_text(gas.n), gas.most_realizations(), interval,
              critical, gas.n * std::pow(critical, 3), versions_text(series), error_note(series)) +
          contact_value_note(),
      .width = 960};
}

}  // namespace haff::campaign
