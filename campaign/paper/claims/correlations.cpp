// SPDX-License-Identifier: GPL-3.0-or-later

// Velocity correlations beside the theory of an incompressible fluid, and their scaling.
#include "analysis/theory/correlations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "analysis/statistics/interpolation.hpp"
#include "analysis/statistics/statistics.hpp"
#include "analysis/theory/cooling.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/paper/claims/claims.hpp"
#include "campaign/paper/figure.hpp"

namespace haff::campaign {
namespace {

using analysis::VelocityCorrelation;

constexpr double moment = 50;         // tau of figure 9
constexpr double nearest_pair = 4;    // sigma: nearer, cells of one sigma smooth what is measured
constexpr double farthest_pair = 20;  // sigma: farther, there is little but noise
constexpr double theory_tolerance = 0.10;  // linear theory; of the root mean square, and of scaling
constexpr double trend_at[] = {1, 2, 4};   // r / (sigma sqrt(tau))
constexpr double ratio_at[] = {4.5, 10.5, 18.5};  // r [sigma]

struct Part {
  const char* name;
  const char* symbol;
  double VelocityCorrelation::*value;
};
constexpr Part parts[] = {{"G_parallel", "G∥", &VelocityCorrelation::parallel},
                          {"G_perpendicular", "G⊥", &VelocityCorrelation::perpendicular}};

double theory_of(const MeanSeries& series, const Part& part, double r, double tau) {
  return analysis::velocity_correlation({.e = series.e, .n = series.n}, r, tau,
                                        analysis::Fluid::incompressible).*
         part.value;
}

// The difference from theory over the pairs' range, as a share of theory in root mean squares: of
// the measured curve, and of chance in it.
struct Deviation {
  double measured = 0, chance = 0;
};

Deviation deviation_of(const MeanSeries& series, const Part& part, const MeanProfile& profile) {
  double difference = 0, chance = 0, scale = 0;
  for (std::size_t i = 0; i < profile.x.size(); ++i) {
    const double r = profile.x[i];
    if (r < nearest_pair || r > farthest_pair) continue;
    const double theory = theory_of(series, part, r, profile.tau);
    difference += std::pow(profile.mean.value[i] - theory, 2);
    chance += std::pow(profile.mean.error[i], 2);
    scale += theory * theory;
  }
  return {std::sqrt(difference / scale), std::sqrt(chance / scale)};
}

void add_deviation(const MeanSeries& series, const Part& part, const MeanProfile& profile,
                   Table& table) {
  const Deviation deviation = deviation_of(series, part, profile);
  if (!std::isfinite(deviation.measured)) return;
  constexpr double bars = 2;  // 68 % to 95 %
  const auto judgement = judge(deviation.measured, bars * deviation.chance, 0,
                               {{"no correlations", 1}}, theory_tolerance);
  table.push_back({.claim = "correlations",
                   .quantity = fmt::format("{} at τ = {:g}: root mean square difference, of {}",
                                           part.symbol, profile.tau, part.symbol),
                   .e = series.e,
                   .n = series.n,
                   .value = deviation.measured,
                   .half_interval = bars * deviation.chance,
                   .reference = 0,
                   .source = "incompressible theory",
                   .criterion = judgement.criterion,
                   .holds = judgement.holds,
                   .note = fmt::format("{:g} σ ≤ r ≤ {:g} σ, N = {}", nearest_pair, farthest_pair,
                                       count_text(series.particles))});
}

// A root mean square hides a trend with distance: the ratio at three distances.
void add_ratios(const MeanSeries& series, const Part& part, const MeanProfile& profile,
                Table& table) {
  for (const double r : ratio_at) {
    const auto ours = analysis::interpolated(profile.x, profile.mean.value, r);
    const auto error = analysis::interpolated(profile.x, profile.mean.error, r);
    if (!ours) continue;
    const double theory = theory_of(series, part, r, profile.tau);
    table.push_back({.claim = "correlation ratio",
                     .quantity = fmt::format("{} over theory at r = {:g} σ, τ = {:g}", part.symbol,
                                             r, profile.tau),
                     .e = series.e,
                     .n = series.n,
                     .value = *ours / theory,
                     .half_interval = error ? std::abs(2 * *error / theory) : Comparison::none,
                     .reference = 1,
                     .source = "incompressible theory"});
  }
}

// The spread of curves about their mean over their common range, in root mean squares.
struct Spread {
  double ours = 0, theory = 0, from = 0, until = 0;
};

std::optional<Spread> spread_of(const MeanSeries& series, const Part& part,
                                const std::vector<ScaledCorrelation>& curves) {
  constexpr double step = 0.1;  // in r / (sigma sqrt(tau))
  struct Sum {
    double spread = 0, scale = 0;
    void add(const std::vector<double>& values) {
      const auto mean = analysis::estimate(values);
      // The spread of single curves, not of their mean.
      spread += std::pow(mean.standard_error, 2) * static_cast<double>(values.size());
      scale += mean.mean * mean.mean;
    }
    double share() const { return std::sqrt(spread / scale); }
  } ours, theory;
  Spread result{.from = Comparison::none};
  for (double x = nearest_pair / std::sqrt(scaling_from); x < farthest_pair; x += step) {
    std::vector<double> values, expected;
    for (const ScaledCorrelation& each : curves) {
      if (const auto y = analysis::interpolated(each.curve.x, each.curve.y, x))
        values.push_back(*y);
      expected.push_back(theory_of(series, part, x * std::sqrt(each.tau), each.tau) *
                         std::pow(each.tau, 1.5));
    }
    if (values.size() < curves.size()) continue;
    ours.add(values);
    theory.add(expected);
    if (!(result.from <= x)) result.from = x;
    result.until = x;
  }
  if (ours.scale == 0) return std::nullopt;
  result.ours = ours.share();
  result.theory = theory.share();
  return result;
}

void add_collapse(const MeanSeries& series, const Part& part, Table& table) {
  const auto curves = scaled_correlations(series, part.name);
  if (curves.size() < 2) return;
  const auto spread = spread_of(series, part, curves);
  if (!spread) return;
  table.push_back(
      {.claim = "collapse",
       .quantity = fmt::format("{} scaled: spread between {} τ", part.symbol, curves.size()),
       .e = series.e,
       .n = series.n,
       .value = spread->ours,
       .reference = 0,
       .source = of_the_paper,
       .criterion = fmt::format("{:g}", theory_tolerance),
       .holds = spread->ours <= theory_tolerance,
       .note = fmt::format("{:g} ≤ τ ≤ {:g}, {:.1f} ≤ r/(σ√τ) ≤ {:.1f}, N = {}; incompressible "
                           "theory itself {:.2f}",
                           scaling_from, scaling_until, spread->from, spread->until,
                           count_text(series.particles), spread->theory)});
  // A spread hides a trend with tau.
  const ScaledCorrelation &first = curves.front(), &last = curves.back();
  for (const double x : trend_at) {
    const auto before = analysis::interpolated(first.curve.x, first.curve.y, x);
    const auto after = analysis::interpolated(last.curve.x, last.curve.y, x);
    if (!before || !after) continue;
    const auto scaled_theory = [&](double tau) {
      return theory_of(series, part, x * std::sqrt(tau), tau) * std::pow(tau, 1.5);
    };
    const double ratio = *after / *before;
    table.push_back({.claim = "collapse trend",
                     .quantity = fmt::format("{} scaled, at r = {:g} σ√τ: τ = {:g} over τ = {:g}",
                                             part.symbol, x, last.tau, first.tau),
                     .e = series.e,
                     .n = series.n,
                     .value = ratio,
                     .reference = 1,
                     .source = "scaling",
                     .criterion = fmt::format("± {:g}", theory_tolerance),
                     .holds = std::abs(ratio - 1) <= theory_tolerance,
                     .note = fmt::format("incompressible theory {:.2f}",
                                         scaled_theory(last.tau) / scaled_theory(first.tau))});
  }
}

}  // namespace

void add_correlations(const Averages& averages, Table& table) {
  const auto available = choose_profiles(averages, base_density, "G_parallel");
  if (available.empty()) return;
  const MeanSeries& series = nearest(available, correlations_restitution);
  for (const Part& part : parts) {
    const MeanProfile* profile = series.profile(part.name, moment);
    if (profile != nullptr && profile->tau > 0) {
      add_deviation(series, part, *profile, table);
      add_ratios(series, part, *profile, table);
    }
    add_collapse(series, part, table);
  }
}

}  // namespace haff::campaign
