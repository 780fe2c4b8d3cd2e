// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 14, not of the paper but its argument: with velocities shuffled, and so without
// correlations, a_2 stays near the value of Enskog-Boltzmann theory and energy is lost nearly at
// that theory's rate. Positions are not shuffled: see the note on shuffled gases in
// engine/README.md.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "campaign/paper/figure.hpp"
#include "campaign/paper/interval_means.hpp"
#include "campaign/paper/uncorrelated.hpp"

namespace haff::campaign {
namespace {

// One sample of a_2 is noise of the size of the value that it settles to. While a_2 still changes,
// each sample is a point; later ones are averaged over intervals of tau that change little in it.
constexpr Intervals intervals{.from = 6, .width = 5};

Curve measured(const MeanSeries& series, RunValue value, double end) {
  Curve curve = measured_curve(series);
  curve.name = series.shuffled_every ? fmt::format("shuffled every {:g}", *series.shuffled_every)
                                     : "not shuffled";
  curve.legend = series.shuffled_every
                     ? fmt::format("shuffled every {{/:Italic τ}} = {:g}", *series.shuffled_every)
                     : curve.name;
  curve.realizations.clear();
  curve.look = Look::symbols;
  add_interval_means(series, value, intervals, end, curve);
  return curve;
}

Panel panel(const std::vector<const MeanSeries*>& gases, bool rate, double end) {
  Panel result{.name = rate ? "gamma_ratio" : "a2",
               .x = {.label = "{/:Italic τ}", .column = "tau", .low = 0, .high = end},
               .y = {.label = rate ? "{/:Italic γ}/{/:Italic γ}_0" : "{/:Italic a}_2",
                     .column = rate ? "gamma_ratio" : "a2"},
               .legend = rate ? "bottom left" : "none"};
  const RunValue value = rate ? RunValue::gamma_ratio : RunValue::a2;
  for (const MeanSeries* series : gases) {
    result.curves.push_back(measured(*series, value, end));
    result.curves.back().colour = colour(result.curves.size() - 1, gases.size());
  }
  const char* quantity = rate ? "gamma_ratio" : "a2";
  if (auto direct = direct_curve(quantity, gases.front()->e, end))
    result.curves.push_back(std::move(*direct));
  result.curves.push_back(first_order_curve(quantity, gases.front()->e, end));
  return result;
}

bool has_data(const MeanSeries& series) {
  return std::ranges::any_of(series.runs, [](const Realization& run) {
    return run.tau.size() > 1 && std::isfinite(run.a2.back()) &&
           std::isfinite(run.gamma_ratio.back());
  });
}

// The same gas, prepared and sampled alike, but for the shuffles.
bool is_twin(const MeanSeries& a, const MeanSeries& b) {
  return a.e == b.e && a.n == b.n && a.particles == b.particles &&
         a.sample_every == b.sample_every && a.equilibrate == b.equilibrate;
}

// A gas that is not shuffled and all its shuffled twins; of each `every` the first.
std::vector<const MeanSeries*> with_twins(const MeanSeries& plain, const Averages& averages) {
  std::vector<const MeanSeries*> gases{&plain};
  for (const MeanSeries& each : averages.shuffled)
    if (is_twin(each, plain) && has_data(each) &&
        gases.back()->shuffled_every != each.shuffled_every)
      gases.push_back(&each);
  return gases;
}

}  // namespace

std::optional<Plot> figure_14(const Averages& averages) {
  std::vector<const MeanSeries*> gases;
  for (const MeanSeries& plain : averages.series) {
    if (plain.e >= 1 || !has_data(plain)) continue;
    auto here = with_twins(plain, averages);
    if (here.size() > std::max<std::size_t>(gases.size(), 1)) gases = std::move(here);
  }
  if (gases.empty()) return std::nullopt;
  double end = gases.front()->tau.back();
  for (const MeanSeries* each : gases) end = std::min(end, each->tau.back());
  Panel a2 = panel(gases, false, end);
  Panel rate = panel(gases, true, end);
  a2.frame = {{0.10, 0.485, 0.215, 0.96}};
  rate.frame = {{0.59, 0.975, 0.215, 0.96}};
  return Plot{.panels = {a2, rate},
              .caption = fmt::format("{} From τ = {:g} on, means over Δτ = {:g}.{}",
                                     provenance({*gases.front()}), intervals.from, intervals.width,
                                     coefficient_error_note({*gases.front()})),
              .width = 960};
}

}  // namespace haff::campaign
