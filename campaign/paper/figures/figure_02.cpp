// SPDX-License-Identifier: GPL-3.0-or-later

// Figure 2: how long the homogeneous stage lasts, tau_c against 2 gamma_0, beside the published
// values and the energy equation's; as an inset tau_c over that of the energy equation, where error
// bars can be seen.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "analysis/theory/cooling.hpp"
#include "analysis/theory/energy_equation.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/text_table.hpp"
#include "campaign/paper/figure.hpp"
#include "campaign/plot/reference_line.hpp"
#include "campaign/results/published.hpp"

namespace haff::campaign {
namespace {

double decay(double e) {
  return 2 * analysis::gamma0(e);
}

Curve theory(double least, double most) {
  Curve curve{.name = "energy equation",
              .legend = fmt::format("energy equation, {{/:Italic b}} = {:.2f}", analysis::cutoff_b),
              .source = Source::theory,
              .n = base_density};
  constexpr int points = 60;
  for (int i = 0; i <= points; ++i) {
    const double rate = least * std::pow(most / least, double(i) / points);
    const double e = std::sqrt(1 - 3 * rate);
    curve.x.push_back(rate);
    curve.y.push_back(analysis::energy_equation_tau_c({.e = e, .n = base_density}));
  }
  return curve;
}

// y of each point over the energy equation's.
Curve over_theory(Curve curve) {
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const double e = std::sqrt(1 - 3 * curve.x[i]);
    const double theory = analysis::energy_equation_tau_c({.e = e, .n = base_density});
    curve.y[i] /= theory;
    if (i < curve.error.size()) curve.error[i] /= theory;
  }
  return curve;
}

Panel ratios(const Curve& paper, const Curve& measured, double low, double high) {
  Panel inset{.name = "ratio",
              .x = {.label = "2{/:Italic γ}_0",
                    .column = "two_gamma0",
                    .logarithmic = true,
                    .low = low,
                    .high = high,
                    .tics = "(0.02, 0.05, 0.1, 0.2)"},
              .y = {.label = "{/:Italic τ}_c / theory", .column = "ratio"},
              .curves = {over_theory(paper), over_theory(measured)},
              .legend = "none",
              .small = true,
              .frame = {{0.60, 0.94, 0.66, 0.95}}};
  const Range range = y_range(inset.curves);
  const double reach =
      1.25 * std::max({range.high - 1, 1 - range.low, 0.01});  // of one, to either side
  inset.y.low = 1 - reach;
  inset.y.high = 1 + reach;
  inset.y.tics = fmt::format("{:g}", round_step(reach / 2));
  inset.commands.push_back(reference_line(1));
  return inset;
}

std::string note(const std::vector<MeanTauC>& measured) {
  std::map<std::pair<std::int64_t, std::string>, std::string> groups;
  for (const MeanTauC& each : measured) {
    std::string realizations = fmt::format("{}", each.reached);
    if (each.reached < each.realizations) {
      realizations += fmt::format(" of {} (the others stopped before)", each.realizations);
    }
    std::string& list = groups[{each.particles, realizations}];
    list += (list.empty() ? "e = " : ", ") + restitution_text(each.e);
  }
  std::string text = fmt::format("n = {:.2f}", base_density);
  for (const auto& [key, list] : groups) {
    text += fmt::format("; {}: N = {}, realizations: {}", list, count_text(key.first), key.second);
  }
  std::set<std::string> versions;
  for (const MeanTauC& each : measured)
    versions.insert(each.code_versions.begin(), each.code_versions.end());
  const bool errors =
      std::ranges::any_of(measured, [](const MeanTauC& t) { return std::isfinite(t.error); });
  text += errors ? ". Bars: 68 % intervals of the mean (Student's t). All e start from the "
                   "same states."
                 : ".";
  if (!versions.empty()) text += fmt::format(" haff {}.", fmt::join(versions, ", "));
  return text;
}

}  // namespace

std::optional<Plot> figure_02(const Averages& averages) {
  const auto chosen = choose_tau_c(averages, base_density);
  if (chosen.empty()) return std::nullopt;

  Curve measured{.name = "measured", .legend = "this work", .n = base_density};
  measured.look = Look::symbols;
  measured.size = 0.8;
  measured.colour = colour(0, 2);
  double least = decay(published_tau_cs.back().e), most = decay(published_tau_cs.front().e);
  for (const MeanTauC& each : chosen) {
    measured.x.push_back(decay(each.e));
    measured.y.push_back(each.tau_c);
    measured.error.push_back(each.error);
    measured.realizations.push_back(each.reached);
    least = std::min(least, decay(each.e));
    most = std::max(most, decay(each.e));
  }
  Curve paper{.name = "Kawahara and Nakanishi",
              .legend = "Kawahara and Nakanishi",
              .source = Source::published,
              .n = base_density};
  paper.look = Look::symbols;
  paper.symbol = 4;
  paper.size = 1.3;
  paper.colour = colour(1, 2);
  for (const PublishedTauC& published : published_tau_cs) {
    paper.x.push_back(decay(published.e));
    paper.y.push_back(published.tau_c);
  }

  constexpr double room = 1.25;  // at the ends of logarithmic axes
  Panel panel{.x = {.label = "2{/:Italic γ}_0",
                    .column = "two_gamma0",
                    .logarithmic = true,
                    .low = least / room,
                    .high = most * room,
                    .tics = "(0.005, 0.01, 0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3)"},
              .y = {.label = "{/:Italic τ}_c",
                    .column = "tau_c",
                    .logarithmic = true,
                    .tics = "(20, 30, 50, 70, 100, 150, 200, 300, 500, 700, 1000, 2000)"},
              .curves = {theory(least / room, most * room), paper, measured}};
  const Range range = y_range(panel.curves, true);
  panel.y.low = range.low / room;
  panel.y.high = range.high * room;
  panel.legend = "bottom left";
  return Plot{.panels = {panel, ratios(paper, measured, *panel.x.low, *panel.x.high)},
              .caption = note(chosen) + contact_value_note()};
}

}  // namespace haff::campaign
