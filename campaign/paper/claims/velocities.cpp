// SPDX-License-Identifier: GPL-3.0-or-later

// How far velocities are from Gaussian: a_2 leaves zero as Enskog-Boltzmann theory has it and
// returns before tau_c. Errors are those that Gaussian velocities have
// (analysis/observables/moments.hpp), which are known better than the scatter of a few
// realizations.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/direct/table.hpp"
#include "analysis/observables/moments.hpp"
#include "analysis/statistics/statistics.hpp"
#include "analysis/theory/energy_equation.hpp"
#include "analysis/theory/enskog_boltzmann.hpp"
#include "campaign/paper/claims/claims.hpp"
#include "campaign/paper/figure.hpp"
#include "campaign/paper/interval_means.hpp"

namespace haff::campaign {
namespace {

constexpr double base_restitution = 0.90;  // of the paper's a_l
constexpr double short_times = 3;          // tau: until then correlations have hardly built up
constexpr double deepest_from = 5, deepest_until = 30;  // tau: a_2 is near its deepest at e = 0.90
constexpr std::size_t return_window = 5;  // samples that the returning a_2 is smoothed over
constexpr double normal_interval = 1.96;  // standard errors, of 95 %

// Half the 95 % interval of the mean of a_l over neighbouring samples that span `width` of tau.
double known_half_interval(const MeanSeries& series, int l, double width) {
  const double independent = std::max(1.0, width / (2 * a2_correlation_time));
  const auto particles = static_cast<double>(series.particles * series.most_realizations());
  return normal_interval * analysis::laguerre_noise(l, particles) / std::sqrt(independent);
}

double mean_over(const MeanSeries& series, const Means& coefficient, double from, double to) {
  double sum = 0;
  int samples = 0;
  for (std::size_t i = 0; i < series.tau.size(); ++i) {
    if (series.tau[i] < from || series.tau[i] > to) continue;
    sum += coefficient.value[i];
    ++samples;
  }
  return sum / samples;  // NaN of none
}

void add_early_a2(const MeanSeries& series, Table& table) {
  const double first = series.tau.size() > 1 ? series.tau[1] : 0;
  if (first <= 0 || first > short_times) return;
  const double ours = mean_over(series, series.a2, first, short_times);
  // The equation's own where the table has this e.
  const auto direct = analysis::tabulated("a2", series.e);
  Means theory, first_order;
  for (const double tau : series.tau) {
    first_order.value.push_back(analysis::boltzmann_a2(tau, series.e));
    theory.value.push_back(direct ? direct->at(tau).value : first_order.value.back());
  }
  const double expected = mean_over(series, theory, first, short_times);
  constexpr double off = 0.2;
  const double half = known_half_interval(series, 2, short_times);
  const auto judgement =
      judge(ours, half, expected,
            {{"a Gaussian gas", 0}, {"a source of a₂ off by 20 %", expected * (1 + off)}});
  table.push_back({.claim = "a2 early",
                   .quantity = fmt::format("a₂, mean over 0 < τ ≤ {:g}", short_times),
                   .e = series.e,
                   .n = series.n,
                   .value = ours,
                   .half_interval = half,
                   .reference = expected,
                   .source = direct ? "Enskog–Boltzmann, by direct simulation"
                                    : "Enskog–Boltzmann, to first order in a₂",
                   .criterion = judgement.criterion,
                   .holds = judgement.holds,
                   .note = fmt::format("{} realizations; to first order in a₂ {:.5f}",
                                       series.most_realizations(),
                                       mean_over(series, first_order, first, short_times))});
}

void add_a2_return(const MeanSeries& series, Table& table) {
  const auto tau_c = mean_tau_c(series);
  if (!tau_c) return;
  const auto end_of_stage = std::ranges::upper_bound(series.tau, tau_c->tau_c);
  const auto samples = static_cast<std::size_t>(end_of_stage - series.tau.begin());
  const auto smooth = analysis::smoothed(series.a2.value, return_window);
  if (samples < 2 * return_window) return;
  // The deepest of the first half: near tau_c a realization may turn either way.
  const auto end = smooth.begin() + static_cast<std::ptrdiff_t>(samples);
  const auto deepest =
      std::min_element(smooth.begin(), smooth.begin() + static_cast<std::ptrdiff_t>(samples / 2));
  const auto back = std::max_element(deepest, end);
  const auto tau_at = [&](auto place) {
    return series.tau[static_cast<std::size_t>(place - smooth.begin())];
  };
  const double left = *back / *deepest;
  const auto direct = analysis::tabulated("a2", series.e);
  const double rest = direct ? direct->plateau.value : analysis::boltzmann_a2_plateau(series.e);
  const double half =
      known_half_interval(series, 2, return_window * series.sample_every) / std::abs(*deepest);
  const auto judgement = judge(left, half, 0, {{"Enskog–Boltzmann theory alone", 1}});
  table.push_back(
      {.claim = "a2 return",
       .quantity = "a₂ on its return before τ_c, over its deepest",
       .e = series.e,
       .n = series.n,
       .value = left,
       .half_interval = half,
       .reference = 0,
       .source = of_the_paper,
       .criterion = judgement.criterion,
       .holds = judgement.holds,
       .note = fmt::format("deepest {:.4f} at τ = {:g} (Enskog–Boltzmann theory comes to "
                           "rest at {:.4f}), back to {:.4f} at τ = {:g}",
                           *deepest, tau_at(deepest), rest, *back, tau_at(back))});
}

// Judged only where the differences are larger than chance makes them.
void add_order(const MeanSeries& series, Table& table) {
  const double a[] = {mean_over(series, series.a2, deepest_from, deepest_until),
                      mean_over(series, series.a3, deepest_from, deepest_until),
                      mean_over(series, series.a4, deepest_from, deepest_until)};
  if (!std::isfinite(a[0] + a[1] + a[2])) return;
  bool confirmed = true, refuted = false;
  for (int k = 0; k < 2; ++k) {
    const double width = std::min(deepest_until, series.tau.back()) - deepest_from;
    const double chance = std::hypot(known_half_interval(series, k + 2, width),
                                     known_half_interval(series, k + 3, width));
    const double difference = std::abs(a[k]) - std::abs(a[k + 1]);
    confirmed = confirmed && difference > chance;
    refuted = refuted || difference < -chance;
  }
  Comparison row{.claim = "order",
                 .quantity = "|a₂| > |a₃| > |a₄|",
                 .e = series.e,
                 .n = series.n,
                 .source = of_the_paper,
                 .criterion = "each difference beyond its 95 % interval",
                 .note = fmt::format("means over {:g} ≤ τ ≤ {:g}: {:.5f}, {:.5f}, {:.5f}",
                                     deepest_from, deepest_until, a[0], a[1], a[2])};
  if (confirmed || refuted) row.holds = confirmed;
  if (!row.holds) row.criterion += "; the error is too large to tell";
  table.push_back(std::move(row));
}

}  // namespace

void add_velocities(const Averages& averages, Table& table) {
  const auto available = choose_series(averages, base_density, &MeanSeries::a2);
  if (available.empty()) return;
  const MeanSeries& series = nearest(available, base_restitution);
  add_early_a2(series, table);
  add_a2_return(series, table);
  add_order(series, table);
}

}  // namespace haff::campaign
