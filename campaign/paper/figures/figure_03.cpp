// Figure 3: the velocity distribution rho(c) at several tau through tau_c at e = 0.80, beside the
// Gaussian exp(-c^2); as an inset the ratio of the two, where it is known to a fifth.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "analysis/theory/energy_equation.hpp"
#include "campaign/paper/figure.hpp"

namespace haff::campaign {
namespace {

constexpr double restitution = 0.80;
constexpr std::array stages = {0.0, 0.5, 1.0, 1.5, 2.0, 3.0};  // tau / tau_c
constexpr double fastest = 4.2;  // c beyond which noise is all there is
constexpr double rarest = 1e-7;  // rho

Curve gaussian() {
  Curve curve{.name = "Gaussian", .legend = "exp(−{/:Italic c}^2)", .source = Source::theory};
  curve.width = 1.6;
  constexpr int points = 100;
  for (int i = 0; i <= points; ++i) {
    const double c = fastest * i / points;
    curve.x.push_back(c);
    curve.y.push_back(std::exp(-c * c));
  }
  return curve;
}

Curve over_gaussian(const Curve& curve) {
  constexpr double known = 0.2;  // relative error beyond which a ratio says nothing
  Curve ratio = curve;
  ratio.x.clear();
  ratio.y.clear();
  ratio.error.clear();
  ratio.realizations.clear();
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const double error = curve.error_at(i);
    if (!(curve.y[i] > 0) || error > known * curve.y[i]) continue;
    const double gauss = std::exp(-curve.x[i] * curve.x[i]);
    ratio.x.push_back(curve.x[i]);
    ratio.y.push_back(curve.y[i] / gauss);
    ratio.error.push_back(error / gauss);
    ratio.realizations.push_back(curve.realizations[i]);
  }
  ratio.legend = "";
  ratio.size = 0.35;
  return ratio;
}

Panel ratios(const std::vector<Curve>& curves) {
  Panel inset{.name = "ratio",
              .x = {.column = "c", .low = 0, .high = 3},
              .y = {.label = "{/:Italic ρ} / exp(−{/:Italic c}^2)", .column = "ratio"},
              .legend = "none",
              .small = true,
              .frame = {{0.70, 0.955, 0.69, 0.955}}};
  for (const Curve& curve : curves) inset.curves.push_back(over_gaussian(curve));
  inset.y.low = 0.5;
  inset.y.high = 1.5;
  inset.y.tics = "0.25";
  inset.commands.push_back(
      "set arrow from graph 0, first 1 to graph 1, first 1 nohead back lw 1 lc rgb '#000000'");
  return inset;
}

// Profiles nearest to the stages, each once.
std::vector<const MeanProfile*> shown(const MeanSeries& series) {
  const double tau_c = analysis::energy_equation_tau_c({.e = series.e, .n = series.n});
  std::vector<const MeanProfile*> profiles;
  for (const double stage : stages) {
    const MeanProfile* profile = series.profile("rho", stage * tau_c);
    if (profiles.empty() || profiles.back() != profile) profiles.push_back(profile);
  }
  return profiles;
}

}  // namespace

std::optional<Plot> figure_03(const Averages& averages) {
  const auto available = choose_profiles(averages, base_density, "rho");
  if (available.empty()) return std::nullopt;
  const MeanSeries& series = nearest(available, restitution);

  Panel panel{.x = {.label = "{/:Italic c}", .column = "c", .low = 0, .high = fastest},
              .y = {.label = "{/:Italic ρ}({/:Italic c})",
                    .column = "rho",
                    .logarithmic = true,
                    .low = rarest,
                    .high = 3,
                    .tics = "format '10^{%T}'"},
              .legend = "bottom left"};
  const auto profiles = shown(series);
  for (const MeanProfile* profile : profiles) {
    Curve curve = measured_curve(series);
    curve.name = fmt::format("tau = {:g}", profile->tau);
    curve.legend = fmt::format("{{/:Italic τ}} = {:g}", profile->tau);
    curve.x = profile->x;
    curve.y = profile->mean.value;
    curve.error = profile->mean.error;
    curve.realizations.assign(curve.x.size(), profile->realizations);
    curve.look = Look::symbols;
    curve.colour = shade(panel.curves.size(), profiles.size());
    panel.curves.push_back(until(fastest, std::move(curve)));
  }
  Panel inset = ratios(panel.curves);
  panel.curves.push_back(gaussian());
  return Plot{.panels = {panel, inset}, .caption = provenance({series}) + error_note({series})};
}

}  // namespace haff::campaign
