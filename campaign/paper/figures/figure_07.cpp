// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 7: a_2 of one realization far into the clustering stage, against tau / tau_c for the four
// e. Measured at integer tau and smoothed over Delta tau = 3, 3, 5, 7, as the paper's.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "analysis/statistics/statistics.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/text_table.hpp"
#include "campaign/paper/figure.hpp"
#include "campaign/plot/reference_line.hpp"

namespace haff::campaign {
namespace {

struct Window {
  double e;
  std::size_t width;  // Delta tau
};
constexpr std::array<Window, 4> windows = {{{0.80, 3}, {0.85, 3}, {0.90, 5}, {0.95, 7}}};

std::size_t window_of(double e) {
  return std::ranges::min_element(windows, {}, [e](const Window& w) { return std::abs(w.e - e); })
      ->width;
}

// The longest realization that reached tau_c; of those as long, the one of the first seed.
const Realization* sample_of(const MeanSeries& series) {
  const Realization* longest = nullptr;
  for (const Realization& run : series.runs) {
    if (!run.tau_c) continue;
    if (longest == nullptr || run.tau.back() > longest->tau.back()) longest = &run;
  }
  return longest;
}

Curve curve_of(const MeanSeries& series, const Realization& run) {
  Curve curve = measured_curve(series);
  curve.realizations.clear();
  std::vector<double> a2;
  for (std::size_t i = 0; i < run.tau.size(); ++i) {
    if (run.tau[i] != std::round(run.tau[i])) continue;
    curve.x.push_back(run.tau[i] / *run.tau_c);
    a2.push_back(run.a2[i]);
  }
  curve.y = analysis::smoothed(a2, window_of(series.e));
  curve.realizations.assign(curve.x.size(), 1);
  return curve;
}

}  // namespace

std::optional<Plot> figure_07(const Averages& averages) {
  Panel panel{.x = {.label = "{/:Italic τ} / {/:Italic τ}_c", .column = "tau_ratio", .low = 0},
              .y = {.label = "{/:Italic a}_2", .column = "a2"},
              .legend = "top left"};
  std::string note;
  double end = 0;
  std::vector<MeanSeries> chosen = choose_series(averages, base_density, &MeanSeries::a2);
  std::erase_if(chosen,
                [](const MeanSeries& s) { return s.sample_every > 1 || sample_of(s) == nullptr; });
  if (chosen.empty()) return std::nullopt;
  for (const MeanSeries& series : chosen) {
    const Realization& run = *sample_of(series);
    Curve curve = curve_of(series, run);
    curve.colour = colour(panel.curves.size(), chosen.size());
    end = std::max(end, curve.x.back());
    note += fmt::format("; e = {}: N = {}, seed {}, Δτ = {}", restitution_text(series.e),
                        count_text(series.particles), run.seed, window_of(series.e));
    panel.curves.push_back(std::move(curve));
  }
  panel.x.high = end;
  panel.commands = {
      reference_line(0),
      "set arrow from first 1, graph 0 to first 1, graph 1 nohead back lw 1 dt (4,4)"};
  return Plot{.panels = {panel},
              .caption = "n = " + density_text(base_density) +
                         "; one realization each, smoothed over Δτ" + note + "." +
                         versions_text(chosen)};
}

}  // namespace haff::campaign
