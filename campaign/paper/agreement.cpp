#include "campaign/paper/agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "analysis/observables/moments.hpp"
#include "analysis/statistics/statistics.hpp"
#include "analysis/theory/cooling.hpp"
#include "analysis/theory/correlations.hpp"
#include "analysis/theory/energy_equation.hpp"
#include "analysis/theory/enskog_boltzmann.hpp"
#include "campaign/base/csv.hpp"
#include "campaign/base/number_text.hpp"
#include "campaign/base/text_table.hpp"
#include "campaign/base/write_file.hpp"
#include "campaign/paper/figure.hpp"
#include "campaign/results/fits.hpp"
#include "campaign/results/published.hpp"

namespace haff::campaign {
namespace {

constexpr double standard_errors = 2;  // that a difference may have
constexpr double tau_c_tolerance = 0.02;
constexpr double energy_tolerance = 0.02;  // of ln E
constexpr double decay_tolerance = 0.01;   // of gamma/gamma_0 averaged over half the stage
constexpr double short_times = 3;          // until then correlations have hardly built up
constexpr double plateau_from = 5;         // a_2 is near its deepest then
constexpr double plateau_until = 30;       // and turns back at e = 0.90
constexpr std::size_t return_window = 5;   // samples that the returning a_2 is smoothed over
constexpr double returned = 0.5;           // of its deepest: on the way back to zero

constexpr double correlations_at = 50;  // tau of figure 9
constexpr double nearest_pair = 4;      // sigma: nearer, cells of one sigma smooth what is measured
constexpr double farthest_pair = 20;    // sigma: farther, there is little but noise
constexpr double correlation_tolerance = 0.10;  // linear theory; of the root mean square
constexpr double collapse_tolerance = 0.10;     // likewise
constexpr double clustered = 0.01;              // of the particles in the largest cluster
constexpr std::size_t long_waves = 4;           // shells of wave vectors

constexpr const char* paper = "Kawahara and Nakanishi";
constexpr double base_restitution = 0.90;  // of the paper's a_l

std::string percent(double share) {
  return fmt::format("{:g} %", 100 * share);
}

// Mean over realizations; errors of one are NaN, and no difference is within them.
bool within(double difference, double error) {
  return std::abs(difference) <= standard_errors * error;
}

void add_tau_c(const Averages& averages, std::vector<Comparison>& table) {
  for (const MeanTauC& each : choose_tau_c(averages, base_density)) {
    const auto published = published_tau_c({.e = each.e, .n = each.n});
    if (!published) continue;
    const double difference = each.tau_c - *published;
    table.push_back(
        {.claim = "tau_c",
         .quantity = "crossover τ_c",
         .e = each.e,
         .n = each.n,
         .value = each.tau_c,
         .error = each.error,
         .reference = *published,
         .source = paper,
         .criterion = percent(tau_c_tolerance) + " or 2 standard errors",
         .holds =
             std::abs(difference) <= tau_c_tolerance * *published || within(difference, each.error),
         .note = fmt::format("95 % bootstrap {:.1f} to {:.1f}, {} realizations; energy equation "
                             "{:.1f}",
                             each.interval.low, each.interval.high, each.reached,
                             analysis::energy_equation_tau_c({.e = each.e, .n = each.n}))});
  }
}

// Samples of a series from tau > 0 until tau_c, or its end.
std::size_t homogeneous_samples(const MeanSeries& series, double share = 1) {
  const auto tau_c = mean_tau_c(series);
  const double end =
      share *
      (tau_c ? tau_c->tau_c : analysis::energy_equation_tau_c({.e = series.e, .n = series.n}));
  return static_cast<std::size_t>(std::ranges::upper_bound(series.tau, end) - series.tau.begin());
}

void add_energy(const Averages& averages, std::vector<Comparison>& table) {
  for (const MeanSeries& series : choose_series(averages, base_density, &MeanSeries::temperature)) {
    const auto theory = analysis::energy_equation({.e = series.e, .n = series.n}, series.tau);
    double worst = 0, worst_tau = 0, worst_energy = 0;
    for (std::size_t i = 1; i < homogeneous_samples(series); ++i) {
      const double ours = std::log(series.temperature.value[i] / analysis::initial_temperature());
      const double difference = ours - std::log(theory[i].energy);
      worst_energy = std::max(worst_energy, std::abs(std::expm1(difference)));
      if (const double relative = std::abs(difference / std::log(theory[i].energy));
          relative > worst) {
        worst = relative;
        worst_tau = series.tau[i];
      }
    }
    table.push_back({.claim = "energy",
                     .quantity = "ln E until τ_c: largest relative difference",
                     .e = series.e,
                     .n = series.n,
                     .value = worst,
                     .reference = 0,
                     .source = fmt::format("energy equation, b = {:.2f}", analysis::cutoff_b),
                     .criterion = percent(energy_tolerance),
                     .holds = worst <= energy_tolerance,
                     .note = fmt::format("at τ = {:g}; E itself differs by {:.1f} % at most",
                                         worst_tau, 100 * worst_energy)});
  }
}

// The mean of gamma/gamma_0 over the first half of the stage is ln E over a straight line: hardly
// any noise, and where theory should hold best.
void add_decay(const MeanSeries& series, std::vector<Comparison>& table) {
  const std::size_t samples = homogeneous_samples(series, 0.5);
  if (samples < 2 || samples > series.tau.size()) return;
  const std::size_t last = samples - 1;
  const double fall = 2 * analysis::gamma0(series.e) * series.tau[last];
  std::vector<double> ratios;
  for (const Realization& run : series.runs) {
    if (run.tau.size() <= last) continue;
    ratios.push_back(std::log(analysis::initial_temperature() / run.temperature[last]) / fall);
  }
  if (ratios.empty()) return;
  const auto ours = analysis::estimate(ratios);
  const std::vector<double> at{series.tau[last]};
  const double theory =
      -std::log(analysis::energy_equation({.e = series.e, .n = series.n}, at).front().energy) /
      fall;
  const double plateau = analysis::boltzmann_gamma_ratio(analysis::boltzmann_a2_plateau(series.e));
  table.push_back({.claim = "decay",
                   .quantity = fmt::format("γ/γ₀, mean until τ = {:g}", series.tau[last]),
                   .e = series.e,
                   .n = series.n,
                   .value = ours.mean,
                   .error = ours.standard_error,
                   .reference = theory,
                   .source = fmt::format("energy equation, b = {:.2f}", analysis::cutoff_b),
                   .criterion = percent(decay_tolerance) + " or 2 standard errors",
                   .holds = std::abs(ours.mean - theory) <= decay_tolerance * theory ||
                            within(ours.mean - theory, ours.standard_error),
                   .note = fmt::format("Enskog–Boltzmann plateau {:.4f}", plateau)});
}

void add_cutoff(const MeanSeries& series, std::vector<Comparison>& table) {
  const auto fit = fitted_cutoff(series);
  if (!fit) return;
  table.push_back({.claim = "cutoff",
                   .quantity = "cutoff b fitted until τ_c",
                   .e = series.e,
                   .n = series.n,
                   .value = fit->mean,
                   .error = fit->standard_error,
                   .reference = analysis::cutoff_b,
                   .source = paper,
                   .note = fmt::format("{} realizations fitted one by one", fit->count)});
}

void add_late_decay(const Averages& averages, std::vector<Comparison>& table) {
  for (const MeanSeries& series : choose_series(averages, base_density, &MeanSeries::temperature)) {
    const auto exponent = late_exponent(series);
    if (!exponent) continue;
    table.push_back({.claim = "late decay",
                     .quantity = "late exponent x of T ~ τ^−x, from 2 τ_c on",
                     .e = series.e,
                     .n = series.n,
                     .value = exponent->mean,
                     .error = exponent->standard_error,
                     .source = "paper: roughly 3 to 4, strongly sample dependent",
                     .note = fmt::format("{} realizations fitted one by one", exponent->count)});
  }
}

// a_2 minus theory, mean over 0 < tau <= 3. The error is that of one sample of Gaussian velocities,
// which is known better than the scatter of a few realizations.
void add_early_a2(const MeanSeries& series, std::vector<Comparison>& table) {
  double ours = 0, theory = 0;
  int samples = 0;
  for (std::size_t i = 0; i < series.tau.size(); ++i) {
    if (series.tau[i] <= 0 || series.tau[i] > short_times) continue;
    ours += series.a2.value[i];
    theory += analysis::boltzmann_a2(series.tau[i], series.e);
    ++samples;
  }
  if (samples == 0) return;
  const double error =
      analysis::laguerre_noise(2, static_cast<double>(series.particles * series.realizations[1]));
  table.push_back({.claim = "a2 early",
                   .quantity = fmt::format("a₂, mean over 0 < τ ≤ {:g}", short_times),
                   .e = series.e,
                   .n = series.n,
                   .value = ours / samples,
                   .error = error,
                   .reference = theory / samples,
                   .source = "Enskog–Boltzmann",
                   .criterion = "2 standard errors",
                   .holds = within((ours - theory) / samples, error),
                   .note = fmt::format("{} realizations", series.realizations[1])});
}

void add_a2_return(const MeanSeries& series, std::vector<Comparison>& table) {
  const std::size_t samples = homogeneous_samples(series);
  const auto smooth = analysis::smoothed(series.a2.value, return_window);
  if (!mean_tau_c(series) || samples < 2 * return_window) return;
  // The deepest of the first half: near tau_c a realization may turn either way.
  const auto end = smooth.begin() + static_cast<std::ptrdiff_t>(samples);
  const auto deepest =
      std::min_element(smooth.begin(), smooth.begin() + static_cast<std::ptrdiff_t>(samples / 2));
  const auto back = std::max_element(deepest, end);
  const auto tau_at = [&](auto place) {
    return series.tau[static_cast<std::size_t>(place - smooth.begin())];
  };
  table.push_back(
      {.claim = "a2 return",
       .quantity = "a₂ on its return before τ_c, over its deepest",
       .e = series.e,
       .n = series.n,
       .value = *back / *deepest,
       .reference = 0,
       .source = paper,
       .criterion = fmt::format("below {:g}", returned),
       .holds = *back / *deepest < returned,
       .note = fmt::format("deepest {:.4f} at τ = {:g} (theory's plateau {:.4f}), back "
                           "to {:.4f} at τ = {:g}",
                           *deepest, tau_at(deepest), analysis::boltzmann_a2_plateau(series.e),
                           *back, tau_at(back))});
}

void add_ordering(const MeanSeries& series, std::vector<Comparison>& table) {
  const auto mean = [&](const Means& coefficient) {
    double sum = 0;
    int samples = 0;
    for (std::size_t i = 0; i < series.tau.size(); ++i) {
      if (series.tau[i] < plateau_from || series.tau[i] > plateau_until) continue;
      sum += coefficient.value[i];
      ++samples;
    }
    return sum / samples;
  };
  const double a2 = mean(series.a2), a3 = mean(series.a3), a4 = mean(series.a4);
  if (!std::isfinite(a2 + a3 + a4)) return;
  table.push_back({.claim = "order",
                   .quantity = "|a₂| > |a₃| > |a₄|",
                   .e = series.e,
                   .n = series.n,
                   .source = paper,
                   .criterion = "as said",
                   .holds = std::abs(a2) > std::abs(a3) && std::abs(a3) > std::abs(a4),
                   .note = fmt::format("means over {:g} ≤ τ ≤ {:g}: {:.5f}, {:.5f}, {:.5f}",
                                       plateau_from, plateau_until, a2, a3, a4)});
}

// How far the measured correlations are from theory, in root mean squares over the pairs' range.
void add_correlations(const MeanSeries& series, std::vector<Comparison>& table) {
  using analysis::VelocityCorrelation;
  struct Part {
    const char* name;
    const char* symbol;
    double VelocityCorrelation::*value;
  };
  for (const Part& part : {Part{"G_parallel", "G∥", &VelocityCorrelation::parallel},
                           Part{"G_perpendicular", "G⊥", &VelocityCorrelation::perpendicular}}) {
    const MeanProfile* profile = series.profile(part.name, correlations_at);
    if (profile == nullptr || profile->tau <= 0) continue;
    double difference = 0, scale = 0;
    for (std::size_t i = 0; i < profile->x.size(); ++i) {
      if (profile->x[i] < nearest_pair || profile->x[i] > farthest_pair) continue;
      const double theory =
          analysis::velocity_correlation({.e = series.e, .n = series.n}, profile->x[i],
                                         profile->tau, analysis::Fluid::incompressible).*
          part.value;
      difference += std::pow(profile->mean.value[i] - theory, 2);
      scale += theory * theory;
    }
    if (scale == 0) continue;
    const double deviation = std::sqrt(difference / scale);
    table.push_back({.claim = "correlations",
                     .quantity = fmt::format("{} at τ = {:g}: root mean square difference",
                                             part.symbol, profile->tau),
                     .e = series.e,
                     .n = series.n,
                     .value = deviation,
                     .reference = 0,
                     .source = "incompressible theory",
                     .criterion = percent(correlation_tolerance),
                     .holds = deviation <= correlation_tolerance,
                     .note = fmt::format("{:g} σ ≤ r ≤ {:g} σ, N = {}", nearest_pair, farthest_pair,
                                         count_text(series.particles))});
  }
}

// A curve at x, linear between its points; nothing outside.
std::optional<double> at(const Curve& curve, double x) {
  const auto above = std::ranges::upper_bound(curve.x, x);
  if (above == curve.x.begin() || above == curve.x.end()) return std::nullopt;
  const auto i = static_cast<std::size_t>(above - curve.x.begin());
  const double share = (x - curve.x[i - 1]) / (curve.x[i] - curve.x[i - 1]);
  return curve.y[i - 1] + share * (curve.y[i] - curve.y[i - 1]);
}

// What theory has at x = r / (sigma sqrt(tau)) for each of the scaled curves, whose tau each knows.
std::vector<double> theory_of(const MeanSeries& series, std::string_view name,
                              const std::vector<ScaledCorrelation>& curves, double x) {
  std::vector<double> values;
  for (const ScaledCorrelation& each : curves) {
    const auto theory =
        analysis::velocity_correlation({.e = series.e, .n = series.n}, x * std::sqrt(each.tau),
                                       each.tau, analysis::Fluid::incompressible);
    values.push_back((name == "G_parallel" ? theory.parallel : theory.perpendicular) *
                     std::pow(each.tau, 1.5) / analysis::initial_temperature());
  }
  return values;
}

// The spread of the scaled curves of figure 10 about their mean, over their common range.
void add_collapse(const MeanSeries& series, std::vector<Comparison>& table) {
  for (const char* name : {"G_parallel", "G_perpendicular"}) {
    const auto curves = scaled_correlations(series, name);
    if (curves.size() < 2) continue;
    constexpr double step = 0.1;  // in r / (sigma sqrt(tau))
    double spread = 0, scale = 0, from = Comparison::none, until = 0;
    double theory_spread = 0, theory_scale = 0;
    for (double x = nearest_pair / std::sqrt(scaling_from); x < farthest_pair; x += step) {
      std::vector<double> values;
      for (const ScaledCorrelation& each : curves) {
        if (const auto y = at(each.curve, x)) values.push_back(*y);
      }
      if (values.size() < curves.size()) continue;
      const auto mean = analysis::estimate(values);
      // The spread of single curves, not of their mean.
      spread += std::pow(mean.standard_error, 2) * static_cast<double>(values.size());
      scale += mean.mean * mean.mean;
      const auto theory = analysis::estimate(theory_of(series, name, curves, x));
      theory_spread += std::pow(theory.standard_error, 2) * static_cast<double>(values.size());
      theory_scale += theory.mean * theory.mean;
      if (!(from <= x)) from = x;
      until = x;
    }
    if (scale == 0) continue;
    const double deviation = std::sqrt(spread / scale);
    table.push_back(
        {.claim = "collapse",
         .quantity =
             fmt::format("{} scaled: spread between {} τ",
                         std::string_view(name) == "G_parallel" ? "G∥" : "G⊥", curves.size()),
         .e = series.e,
         .n = series.n,
         .value = deviation,
         .reference = 0,
         .source = paper,
         .criterion = percent(collapse_tolerance),
         .holds = deviation <= collapse_tolerance,
         .note = fmt::format("{:g} ≤ τ ≤ {:g}, {:.1f} ≤ r/(σ√τ) ≤ {:.1f}, N = {}; incompressible "
                             "theory itself {:.1f} %",
                             scaling_from, scaling_until, from, until, count_text(series.particles),
                             100 * std::sqrt(theory_spread / theory_scale))});
  }
}

// When clusters appear: measured beside tau_c, not judged.
void add_onset(const MeanSeries& series, std::vector<Comparison>& table) {
  const auto tau_c = mean_tau_c(series);
  std::vector<double> onsets;
  for (const Realization& run : series.runs) {
    const auto found =
        std::ranges::find_if(run.largest_cluster, [](double part) { return part >= clustered; });
    if (found == run.largest_cluster.end()) continue;
    onsets.push_back(run.tau[static_cast<std::size_t>(found - run.largest_cluster.begin())]);
  }
  if (!onsets.empty()) {
    const auto onset = analysis::estimate(onsets);
    table.push_back(
        {.claim = "clusters",
         .quantity = fmt::format("τ when the largest cluster holds {}", percent(clustered)),
         .e = series.e,
         .n = series.n,
         .value = onset.mean,
         .error = onset.standard_error,
         .source = "measured",
         .note = tau_c ? fmt::format("{:.2f} τ_c", onset.mean / tau_c->tau_c) : std::string()});
  }
  for (const MeanProfile& profile : series.profiles) {
    if (profile.name != "S" || profile.x.size() < long_waves) continue;
    const std::vector<double> waves(profile.mean.value.begin(),
                                    profile.mean.value.begin() + long_waves);
    if (analysis::estimate(waves).mean < 1) continue;
    table.push_back(
        {.claim = "structure",
         .quantity = "τ when S(k) of the longest waves exceeds 1",
         .e = series.e,
         .n = series.n,
         .value = profile.tau,
         .source = "measured",
         .note = fmt::format(
             "mean of k ≤ {:.3g}/σ{}", profile.x[long_waves - 1],
             tau_c ? fmt::format("; {:.2f} τ_c", profile.tau / tau_c->tau_c) : std::string())});
    return;
  }
}

}  // namespace

std::vector<Comparison> agreement(const Averages& averages) {
  std::vector<Comparison> table;
  add_tau_c(averages, table);
  add_energy(averages, table);
  const auto restitutions = choose_series(averages, base_density, &MeanSeries::gamma_ratio);
  auto densities = choose_densities(averages, densities_restitution, &MeanSeries::gamma_ratio);
  std::erase_if(densities, [](const MeanSeries& s) { return s.n == base_density; });
  for (const auto& add : {add_decay, add_cutoff}) {
    for (const MeanSeries& series : restitutions) add(series, table);
    for (const MeanSeries& series : densities) add(series, table);
  }
  const auto available = choose_series(averages, base_density, &MeanSeries::a2);
  if (!available.empty()) {
    const MeanSeries& series = nearest(available, base_restitution);
    add_early_a2(series, table);
    add_a2_return(series, table);
    add_ordering(series, table);
  }
  const auto correlated = choose_profiles(averages, base_density, "G_parallel");
  if (!correlated.empty()) {
    add_correlations(nearest(correlated, correlations_restitution), table);
    add_collapse(nearest(correlated, correlations_restitution), table);
  }
  for (const MeanSeries& series : restitutions) add_onset(series, table);
  add_late_decay(averages, table);
  return table;
}

void write_agreement(const std::vector<Comparison>& table, const std::filesystem::path& file) {
  std::string text = csv_row("claim", "quantity", "e", "n", "value", "standard_error", "reference",
                             "source", "criterion", "holds", "note");
  for (const Comparison& row : table) {
    text +=
        csv_row(row.claim, row.quantity, row.e, row.n, row.value, row.error, row.reference,
                row.source, row.criterion, row.holds ? (*row.holds ? "yes" : "no") : "", row.note);
  }
  write_file(file, text);
}

}  // namespace haff::campaign
