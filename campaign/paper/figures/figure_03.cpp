// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 3: the velocity distribution rho(c) at several tau through tau_c at e = 0.80, beside the
// Gaussian exp(-c^2); as an inset the ratio of the two, where it is known to a fifth. Of the
// Gaussian, too, the mean over a bin is taken there: at c = 3 it is 1.4 % more than its value in
// the middle.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "analysis/observables/distribution.hpp"
#include "analysis/theory/energy_equation.hpp"
#include "campaign/paper/figure.hpp"
#include "campaign/plot/reference_line.hpp"

namespace haff::campaign {
namespace {

constexpr double restitution = 0.80;
constexpr std::array stages = {0.0, 0.5, 1.0, 1.5, 2.0, 3.0};  // tau / tau_c
constexpr double fastest_shown = 4.2;  // c beyond which noise is all there is
constexpr double rarest = 1e-7;        // rho
constexpr double ratio_until = 3.3;    // c, of the inset

Curve gaussian() {
  Curve curve{.name = "Gaussian", .legend = "exp(−{/:Italic c}^2)", .source = Source::theory};
  curve.width = 1.6;
  constexpr int points = 100;
  for (int i = 0; i <= points; ++i) {
    const double c = fastest_shown * i / points;
    curve.x.push_back(c);
    curve.y.push_back(std::exp(-c * c));
  }
  return curve;
}

// Mean of exp(-c^2) over the shell of velocities of the bin around c.
double gaussian_of_bin(double c) {
  const auto below = [](double end) {  // int_0^end c^2 exp(-c^2) dc
    const double tail = end * std::exp(-end * end);
    return 0.25 * (std::sqrt(std::numbers::pi) * std::erf(end) - 2 * tail);
  };
  const double from = c - analysis::speed_bin / 2, to = c + analysis::speed_bin / 2;
  return 3 * (below(to) - below(from)) / (to * to * to - from * from * from);
}

// Relative standard error of a Gaussian's bin by the particles that are in it.
double counting_error(double c, double particles) {
  const double share = 4 / std::sqrt(std::numbers::pi) * c * c * analysis::speed_bin;
  return 1 / std::sqrt(particles * share * gaussian_of_bin(c));
}

Curve over_gaussian(const Curve& curve) {
  constexpr double known = 0.2;  // relative error beyond which a ratio says nothing
  Curve ratio = curve;
  ratio.x.clear();
  ratio.y.clear();
  ratio.error.clear();
  ratio.realizations.clear();
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const double error = curve.error_at(i), c = curve.x[i];
    const double particles = static_cast<double>(*curve.particles * curve.realizations[i]);
    if (!(curve.y[i] > 0) || error > known * curve.y[i] || counting_error(c, particles) > known)
      continue;
    const double gauss = gaussian_of_bin(c);
    ratio.x.push_back(c);
    ratio.y.push_back(curve.y[i] / gauss);
    ratio.error.push_back(error / gauss);
    ratio.realizations.push_back(curve.realizations[i]);
  }
  ratio.legend = "";
  ratio.size = 0.35;
  ratio.joined = true;
  return ratio;
}

Panel ratios(const std::vector<Curve>& curves) {
  Panel inset{.name = "ratio",
              .x = {.column = "c", .low = 0, .high = ratio_until, .tics = "1"},
              .y = {.label = "{/:Italic ρ} / exp(−{/:Italic c}^2)", .column = "ratio"},
              .legend = "none",
              .small = true,
              .frame = {{0.70, 0.955, 0.69, 0.955}}};
  for (const Curve& curve : curves)
    inset.curves.push_back(until(ratio_until, over_gaussian(curve)));
  const Range range = y_range(inset.curves);
  const double reach =
      1.15 * std::max({range.high - 1, 1 - range.low, 0.05});  // of one, to either side
  inset.y.low = 1 - reach;
  inset.y.high = 1 + reach;
  inset.y.tics = fmt::format("{:g}", round_step(reach / 3));
  inset.commands.push_back(reference_line(1));
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

  Panel panel{.x = {.label = "{/:Italic c}", .column = "c", .low = 0, .high = fastest_shown},
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
    panel.curves.push_back(until(fastest_shown, std::move(curve)));
  }
  Panel inset = ratios(panel.curves);
  panel.curves.push_back(gaussian());
  return Plot{.panels = {panel, inset}, .caption = provenance({series}) + error_note({series})};
}

}  // namespace haff::campaign
