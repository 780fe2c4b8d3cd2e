// SPDX-License-Identifier: GPL-3.0-or-later

// How fast the gas cools. Theory: the energy equation with the loss of Enskog-Boltzmann theory
// (analysis/theory/energy_equation.hpp). Its rivals, which every claim must be able to refute:
// Haff's law, Enskog-Boltzmann theory without correlations, and the energy equation with b off by
// 20 %.
#include "analysis/theory/cooling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/theory/correlations.hpp"
#include "analysis/theory/energy_equation.hpp"
#include "analysis/theory/enskog_boltzmann.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/paper/claims/claims.hpp"
#include "campaign/paper/figure.hpp"
#include "campaign/results/fits.hpp"
#include "campaign/results/published.hpp"

namespace haff::campaign {
namespace {

constexpr auto with_f = analysis::Velocities::enskog_boltzmann;
constexpr double b_off = 0.2;  // of b, in rivals

const std::string theory_name = fmt::format("energy equation, b = {:.2f}", analysis::cutoff_b);

// ln E at increasing tau.
using LnEnergy = std::function<std::vector<double>(const std::vector<double>& tau)>;

LnEnergy energy_equation_of(const MeanSeries& series, double b,
                            analysis::Velocities velocities = with_f) {
  return [=, gas = analysis::Gas{.e = series.e, .n = series.n}](const std::vector<double>& tau) {
    std::vector<double> values;
    for (const auto& point : analysis::energy_equation(gas, tau, b, velocities))
      values.push_back(std::log(point.energy));
    return values;
  };
}

// Without correlations the energy equation is that of b = 0; a small b does as well.
constexpr double no_correlations = 1e-3;

struct NamedTheory {
  std::string name;
  LnEnergy ln_energy;
};

std::vector<NamedTheory> rivals_of(const MeanSeries& series) {
  constexpr double b = analysis::cutoff_b;
  return {
      {"Haff's law", energy_equation_of(series, no_correlations, analysis::Velocities::gaussian)},
      {"Enskog–Boltzmann theory alone", energy_equation_of(series, no_correlations)},
      {fmt::format("b = {:.2f}", b * (1 - b_off)), energy_equation_of(series, b * (1 - b_off))},
      {fmt::format("b = {:.2f}", b * (1 + b_off)), energy_equation_of(series, b * (1 + b_off))}};
}

// Samples of a series from tau > 0 until a share of tau_c, or its end.
std::vector<double> homogeneous_tau(const MeanSeries& series, double share = 1) {
  const auto tau_c = mean_tau_c(series);
  const double end =
      share *
      (tau_c ? tau_c->tau_c : analysis::energy_equation_tau_c({.e = series.e, .n = series.n}));
  std::vector<double> tau;
  for (const double each : series.tau)
    if (each > 0 && each <= end) tau.push_back(each);
  return tau;
}

std::size_t sample_at(const MeanSeries& series, double tau) {
  return static_cast<std::size_t>(std::ranges::find(series.tau, tau) - series.tau.begin());
}

// ln E of each realization that goes as far as this sample.
std::vector<double> ln_energies(const MeanSeries& series, std::size_t sample) {
  std::vector<double> values;
  for (const Realization& run : series.runs)
    if (sample < run.tau.size())
      values.push_back(std::log(run.temperature[sample] / analysis::initial_temperature()));
  return values;
}

// tau_c is held to the published value; rivals are shifted in proportion.
void add_tau_c(const Averages& averages, Table& table) {
  for (const MeanTauC& each : choose_tau_c(averages, base_density)) {
    const auto published = published_tau_c({.e = each.e, .n = each.n});
    if (!published) continue;
    const analysis::Gas gas{.e = each.e, .n = each.n};
    const double theory = analysis::energy_equation_tau_c(gas, analysis::cutoff_b, with_f);
    std::vector<Rival> rivals;
    for (const double off : {-b_off, b_off}) {
      const double b = analysis::cutoff_b * (1 + off);
      rivals.push_back({fmt::format("b = {:.2f}", b),
                        *published * analysis::energy_equation_tau_c(gas, b, with_f) / theory});
    }
    const auto judgement = judge(each.tau_c, each.half_interval, *published, rivals);
    table.push_back(
        {.claim = "tau_c",
         .quantity = "crossover τ_c",
         .e = each.e,
         .n = each.n,
         .value = each.tau_c,
         .half_interval = each.half_interval,
         .reference = *published,
         .source = of_the_paper,
         .criterion = judgement.criterion,
         .holds = judgement.holds,
         .note = fmt::format("{} realizations; energy equation {:.1f}, without "
                             "Enskog–Boltzmann's part {:.1f}",
                             each.reached, theory, analysis::energy_equation_tau_c(gas))});
  }
}

// The largest |ln E - theory| until tau_c, beside that of the rivals.
void add_energy(const Averages& averages, Table& table) {
  for (const MeanSeries& series : choose_series(averages, base_density, &MeanSeries::temperature)) {
    const auto tau = homogeneous_tau(series);
    if (tau.empty()) continue;
    const auto theory = energy_equation_of(series, analysis::cutoff_b)(tau);
    const auto largest = [&](const std::vector<double>& ln_energy) {
      double worst = 0;
      for (std::size_t i = 0; i < tau.size(); ++i)
        worst = std::max(worst, std::abs(ln_energy[i] - theory[i]));
      return worst;
    };
    std::vector<Rival> rivals;
    for (const NamedTheory& rival : rivals_of(series))
      rivals.push_back({rival.name, largest(rival.ln_energy(tau))});

    double worst = 0, half = Comparison::none, worst_tau = 0;
    for (std::size_t i = 0; i < tau.size(); ++i) {
      const auto values = ln_energies(series, sample_at(series, tau[i]));
      if (values.empty()) continue;
      const auto ours = analysis::estimate(values);
      const double difference = std::abs(ours.mean - theory[i]);
      if (difference < worst) continue;
      worst = difference;
      half = half_interval_of(ours);
      worst_tau = tau[i];
    }
    const auto judgement = judge(worst, half, 0, rivals);
    table.push_back(
        {.claim = "energy",
         .quantity = "ln E until τ_c: largest difference",
         .e = series.e,
         .n = series.n,
         .value = worst,
         .half_interval = half,
         .reference = 0,
         .source = theory_name,
         .criterion = judgement.criterion,
         .holds = judgement.holds,
         .note = fmt::format(
             "at τ = {:g}, where ln E is {:.3f}", worst_tau,
             theory[static_cast<std::size_t>(std::ranges::find(tau, worst_tau) - tau.begin())])});
  }
}

// The mean of gamma/gamma_0 over the first half of the stage is ln E over a straight line: hardly
// any noise, and where theory should hold best.
void add_decay(const MeanSeries& series, Table& table) {
  const auto tau = homogeneous_tau(series, 0.5);
  if (tau.empty()) return;
  const double end = tau.back();
  const double fall = 2 * analysis::gamma0(series.e) * end;
  auto values = ln_energies(series, sample_at(series, end));
  if (values.empty()) return;
  for (double& value : values) value /= -fall;
  const auto ours = analysis::estimate(values);
  const auto rate = [&](const LnEnergy& theory) { return -theory({end}).front() / fall; };
  const double theory = rate(energy_equation_of(series, analysis::cutoff_b));
  std::vector<Rival> rivals;
  for (const NamedTheory& rival : rivals_of(series))
    rivals.push_back({rival.name, rate(rival.ln_energy)});
  const auto judgement = judge(ours.mean, half_interval_of(ours), theory, rivals);
  table.push_back(
      {.claim = "decay",
       .quantity = fmt::format("γ/γ₀, mean until τ = {:g}", end),
       .e = series.e,
       .n = series.n,
       .value = ours.mean,
       .half_interval = half_interval_of(ours),
       .reference = theory,
       .source = theory_name,
       .criterion = judgement.criterion,
       .holds = judgement.holds,
       .note = fmt::format(
           "Enskog–Boltzmann alone {:.4f}; energy equation without it {:.4f}", rivals[1].value,
           rate(energy_equation_of(series, analysis::cutoff_b, analysis::Velocities::gaussian)))});
}

void add_cutoff(const MeanSeries& series, Table& table) {
  const auto fit = fitted_cutoff(series);
  if (!fit) return;
  const double half = half_interval_of(*fit);
  const auto judgement = judge(fit->mean, half, analysis::cutoff_b,
                               {{"b off by 20 %", analysis::cutoff_b * (1 + b_off)}});
  table.push_back({.claim = "cutoff",
                   .quantity = "cutoff b fitted until τ_c",
                   .e = series.e,
                   .n = series.n,
                   .value = fit->mean,
                   .half_interval = half,
                   .reference = analysis::cutoff_b,
                   .source = of_the_paper,
                   .criterion = judgement.criterion,
                   .holds = judgement.holds,
                   .note = fmt::format("{} of {} realizations fitted one by one", fit->count,
                                       series.runs.size())});
}

void add_late_decay(const Averages& averages, Table& table) {
  for (const MeanSeries& series : choose_series(averages, base_density, &MeanSeries::temperature)) {
    const auto exponent = late_exponent(series);
    if (!exponent) continue;
    std::string slopes;
    for (const auto& local : late_local_exponents(series))
      slopes += fmt::format("{}{:.1f}", slopes.empty() ? "" : ", ", local.mean);
    table.push_back(
        {.claim = "late decay",
         .quantity = "late exponent x of T ~ τ^−x, from 2 τ_c on",
         .e = series.e,
         .n = series.n,
         .value = exponent->mean,
         .half_interval = half_interval_of(*exponent),
         .source = "paper: roughly 3 to 4, strongly sample dependent",
         .note = fmt::format("local slopes in thirds of ln τ: {}; where they differ T is no power "
                             "of τ; {} realizations fitted one by one",
                             slopes, exponent->count)});
  }
}

}  // namespace

void add_cooling(const Averages& averages, Table& table) {
  add_tau_c(averages, table);
  add_energy(averages, table);
  const auto restitutions = choose_series(averages, base_density, &MeanSeries::gamma_ratio);
  auto densities = choose_densities(averages, densities_restitution, &MeanSeries::gamma_ratio);
  std::erase_if(densities, [](const MeanSeries& s) { return s.n == base_density; });
  for (const auto& add : {add_decay, add_cutoff}) {
    for (const MeanSeries& series : restitutions) add(series, table);
    for (const MeanSeries& series : densities) add(series, table);
  }
  add_late_decay(averages, table);
}

}  // namespace haff::campaign
