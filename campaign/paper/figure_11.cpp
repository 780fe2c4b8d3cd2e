// Figure 11: the local decay rate gamma(tau)/gamma_0 in the early stage. It falls below one from
// the start, as the energy equation says, and far more than Enskog-Boltzmann theory allows; of
// that the curve shown is the one that deviates most (e = 0.865).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/theory/energy_equation.hpp"
#include "campaign/paper/figure.hpp"
#include "campaign/paper/interval_means.hpp"
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

// Samples of tau = 1 crowd where curves lie close together.
constexpr Intervals intervals{.from = 4, .width = 3};

std::vector<double> times(double end) {
  constexpr int points = 200;
  std::vector<double> tau;
  for (int i = 0; i <= points; ++i) tau.push_back(end * i / points);
  return tau;
}

// With the loss of Enskog-Boltzmann theory as a line, without it, as the paper has it, dotted.
Curve energy_equation(double e, double end, analysis::Velocities velocities) {
  const bool gaussian = velocities == analysis::Velocities::gaussian;
  Curve curve{.name = gaussian ? "energy equation, Gaussian velocities"
                               : "energy equation, Enskog-Boltzmann velocities",
              .source = Source::theory,
              .e = e,
              .n = base_density,
              .look = gaussian ? Look::dotted : Look::line};
  if (gaussian) curve.width = 1.2;
  for (const auto& point : analysis::energy_equation({.e = e, .n = base_density}, times(end),
                                                     analysis::cutoff_b, velocities)) {
    curve.x.push_back(point.tau);
    curve.y.push_back(point.gamma_ratio);
  }
  return curve;
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
    Curve curve = measured_curve(series);
    curve.realizations.clear();
    add_interval_means(series, RunValue::gamma_ratio, intervals, end, curve);
    curve.look = Look::symbols;
    curve.colour = colour(panel.curves.size(), chosen.size());
    panel.curves.push_back(std::move(curve));
  }
  for (const auto velocities :
       {analysis::Velocities::enskog_boltzmann, analysis::Velocities::gaussian})
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      panel.curves.push_back(energy_equation(chosen[i].e, end, velocities));
      panel.curves.back().colour = colour(i, chosen.size());
    }
  panel.curves.push_back(
      {.legend = fmt::format("energy equation, {{/:Italic b}} = {:.2f}", analysis::cutoff_b)});
  panel.curves.push_back(
      {.legend = "the same, Gaussian velocities", .look = Look::dotted, .width = 1.2});
  Curve boltzmann = direct_curve("gamma_ratio", deepest_a2, end).value();  // tabulated
  boltzmann.legend = "Enskog–Boltzmann, {/:Italic e} = 0.865";
  boltzmann.look = Look::dashed;
  panel.curves.push_back(std::move(boltzmann));
  const Range range = y_range(panel.curves);
  panel.y.low = range.low - 0.04 * range.width();
  panel.y.high = range.high + 0.04 * range.width();
  return Plot{.panels = {panel},
              .caption = provenance(chosen) +
                         fmt::format(" From τ = {:g} on, means over Δτ = {:g}.", intervals.from,
                                     intervals.width) +
                         error_note(chosen)};
}

}  // namespace haff::campaign
