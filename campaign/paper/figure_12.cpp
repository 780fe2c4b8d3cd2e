// Figure 12: the local decay rate gamma(tau)/gamma_0 for several densities at e = 0.85. The energy
// equation depends on n through the correlations; Enskog-Boltzmann theory does not.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/theory/energy_equation.hpp"
#include "campaign/base/number_text.hpp"
#include "campaign/paper/figure.hpp"
#include "campaign/paper/interval_means.hpp"
#include "campaign/paper/uncorrelated.hpp"

namespace haff::campaign {
namespace {

constexpr double restitution = densities_restitution;

// Samples of tau = 1 crowd where curves lie close together.
constexpr Intervals intervals{.from = 4, .width = 3};

std::vector<double> times(double end) {
  constexpr int points = 200;
  std::vector<double> tau;
  for (int i = 0; i <= points; ++i) tau.push_back(end * i / points);
  return tau;
}

// With the loss of Enskog-Boltzmann theory as a line, without it, as the paper has it, dotted.
Curve energy_equation(double n, double end, analysis::Velocities velocities) {
  const bool gaussian = velocities == analysis::Velocities::gaussian;
  Curve curve{.name = gaussian ? "energy equation, Gaussian velocities"
                               : "energy equation, Enskog-Boltzmann velocities",
              .source = Source::theory,
              .e = restitution,
              .n = n,
              .look = gaussian ? Look::dotted : Look::line};
  if (gaussian) curve.width = 1.2;
  for (const auto& point : analysis::energy_equation({.e = restitution, .n = n}, times(end),
                                                     analysis::cutoff_b, velocities)) {
    curve.x.push_back(point.tau);
    curve.y.push_back(point.gamma_ratio);
  }
  return curve;
}

Curve boltzmann(double end) {
  Curve curve = direct_curve("gamma_ratio", restitution, end).value();  // tabulated
  curve.look = Look::dashed;
  return curve;
}

// The same again where curves of dilute gases lie, which differ by less than a hundredth.
Panel dilute(Panel panel) {
  constexpr double densest = 0.2;
  std::erase_if(panel.curves, [](const Curve& curve) {
    return curve.x.empty() || (curve.n && *curve.n > densest);
  });
  for (Curve& curve : panel.curves) curve.legend = "";
  panel.name = "dilute";
  panel.legend = "none";
  panel.y.low = 0.96;
  panel.y.high = 1.01;
  panel.frame = {{0.59, 0.98, 0.215, 0.975}};
  return panel;
}

}  // namespace

std::optional<Plot> figure_12(const Averages& averages) {
  const auto chosen = choose_densities(averages, restitution, &MeanSeries::gamma_ratio);
  if (chosen.empty()) return std::nullopt;
  // The early stage: until the densest gas has lost its homogeneity.
  const double crossover =
      analysis::energy_equation_tau_c({.e = restitution, .n = chosen.back().n});
  const double end = std::min(chosen.back().tau.back(), 10 * std::ceil(crossover / 10));

  Panel panel{.x = {.label = "{/:Italic τ}", .column = "tau", .low = 0, .high = end},
              .y = {.label = "{/:Italic γ} / {/:Italic γ}_0", .column = "gamma_ratio"},
              .legend = "bottom left"};
  std::vector<Curve> theories;
  for (const MeanSeries& series : chosen) {
    Curve curve = measured_curve(series);
    curve.name = "n = " + density_text(series.n);
    curve.legend = "{/:Italic n} = " + density_text(series.n);
    curve.realizations.clear();
    add_interval_means(series, RunValue::gamma_ratio, intervals, end, curve);
    curve.look = Look::symbols;
    curve.colour = shade(panel.curves.size(), chosen.size());
    for (const auto velocities :
         {analysis::Velocities::enskog_boltzmann, analysis::Velocities::gaussian}) {
      theories.push_back(energy_equation(series.n, end, velocities));
      theories.back().colour = curve.colour;
    }
    panel.curves.push_back(std::move(curve));
  }
  panel.curves.insert(panel.curves.end(), theories.begin(), theories.end());
  panel.curves.push_back(
      {.legend = fmt::format("energy equation, {{/:Italic b}} = {:.2f}", analysis::cutoff_b)});
  panel.curves.push_back(
      {.legend = "the same, Gaussian velocities", .look = Look::dotted, .width = 1.2});
  panel.curves.push_back(boltzmann(end));
  const Range range = y_range(panel.curves);
  panel.y.low = range.low - 0.04 * range.width();
  panel.y.high = range.high + 0.04 * range.width();
  panel.frame = {{0.09, 0.50, 0.215, 0.975}};
  return Plot{.panels = {panel, dilute(panel)},
              .caption = provenance(chosen) +
                         fmt::format(" From τ = {:g} on, means over Δτ = {:g}.", intervals.from,
                                     intervals.width) +
                         error_note(chosen),
              .width = 960};
}

}  // namespace haff::campaign
