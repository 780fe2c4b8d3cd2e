// Figure 14, not of the paper but its argument: with velocities shuffled, and so without
// correlations, a_2 stays on the Enskog-Boltzmann plateau and energy is lost at that theory's rate.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/enskog_boltzmann.hpp"
#include "analysis/statistics.hpp"
#include "campaign/paper/figure.hpp"

namespace haff::campaign {
namespace {

// One run's a_2 is noise of the size of the plateau: averaged over so many samples. [odd]
constexpr std::size_t window = 11;

Curve measured(const MeanSeries& series, const Means& means, bool shuffled, double end) {
  Curve curve = measured_curve(series);
  curve.name = shuffled ? "shuffled" : "not shuffled";
  curve.legend = curve.name;
  curve.colour = colour(shuffled ? 1 : 0, 2);
  for (std::size_t i = 0; i < series.tau.size(); ++i) {
    if (!std::isfinite(means.value[i])) continue;  // there is no rate at tau = 0
    curve.x.push_back(series.tau[i]);
    curve.y.push_back(means.value[i]);
  }
  curve.y = analysis::smoothed(curve.y, window);
  curve.realizations.resize(curve.x.size(), series.most_realizations());
  return until(end, std::move(curve));
}

Curve theory(double e, double end, bool rate) {
  Curve curve{.name = "Enskog-Boltzmann",
              .legend = "Enskog–Boltzmann",
              .source = Source::theory,
              .e = e,
              .look = Look::dashed};
  constexpr int points = 200;
  for (int i = 0; i <= points; ++i) {
    const double tau = end * i / points;
    const double a2 = analysis::boltzmann_a2(tau, e);
    curve.x.push_back(tau);
    curve.y.push_back(rate ? analysis::boltzmann_gamma_ratio(a2) : a2);
  }
  return curve;
}

Panel panel(const MeanSeries& plain, const MeanSeries& shuffled, Observable observable,
            double end) {
  const bool rate = observable == &MeanSeries::gamma_ratio;
  return {
      .name = rate ? "gamma_ratio" : "a2",
      .x = {.label = "{/:Italic τ}", .column = "tau", .low = 0, .high = end},
      .y = {.label = rate ? "{/:Italic γ}/{/:Italic γ}_0" : "{/:Italic a}_2",
            .column = rate ? "gamma_ratio" : "a2"},
      .curves = {measured(plain, plain.*observable, false, end),
                 measured(shuffled, shuffled.*observable, true, end), theory(plain.e, end, rate)},
      .legend = rate ? "bottom left" : "none"};
}

}  // namespace

std::optional<Plot> figure_14(const Averages& averages) {
  for (const MeanSeries& shuffled : averages.shuffled) {
    const auto plain = std::ranges::find_if(averages.series, [&](const MeanSeries& each) {
      return each.e == shuffled.e && each.n == shuffled.n && each.particles == shuffled.particles;
    });
    if (plain == averages.series.end()) continue;
    const double end = std::min(plain->tau.back(), shuffled.tau.back());
    Panel a2 = panel(*plain, shuffled, &MeanSeries::a2, end);
    Panel rate = panel(*plain, shuffled, &MeanSeries::gamma_ratio, end);
    a2.frame = {{0.10, 0.485, 0.215, 0.96}};
    rate.frame = {{0.59, 0.975, 0.215, 0.96}};
    return Plot{
        .panels = {a2, rate},
        .caption = fmt::format("{} Mean of {} neighbouring samples.", provenance({*plain}), window),
        .width = 960};
  }
  return std::nullopt;
}

}  // namespace haff::campaign
