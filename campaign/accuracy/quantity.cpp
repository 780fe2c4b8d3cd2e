// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/accuracy/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/statistics/accuracy.hpp"
#include "analysis/statistics/interpolation.hpp"
#include "analysis/statistics/statistics.hpp"
#include "analysis/theory/cooling.hpp"
#include "campaign/base/text/number_text.hpp"

namespace haff::campaign {
namespace {

// tau of a sample and ends of a window are both rounded. [tau]
constexpr double rounding = 1e-9;

// Where a_2 of 0.8 <= e < 1 is near its plateau, before velocity correlations draw it back. [tau]
constexpr double plateau_from = 5, plateau_to = 15;

// gamma is averaged over this much to either side. [tau]
constexpr double decay_reach = 2;

// G_parallel: a distance beyond the cells of its mesh and within a small box. [sigma]
constexpr double correlation_r = 5;

// With blocks of this many correlation times, measured with these very blocks, the error is at most
// a tenth too small.
constexpr double long_enough = 8;

using Samples = std::vector<schema::Sample>;

Samples every_so_manieth(const Samples& samples, std::size_t every) {
  Samples some;
  for (std::size_t k = 0; k < samples.size(); k += every) some.push_back(samples[k]);
  return some;
}

Samples within(const Samples& samples, double from, double to) {
  Samples some;
  for (const schema::Sample& sample : samples)
    if (sample.tau >= from - rounding && sample.tau <= to + rounding) some.push_back(sample);
  return some;
}

bool reaches(const Samples& samples, double tau) {
  return !samples.empty() && samples.back().tau >= tau - rounding;
}

std::optional<double> laguerre(Measure measure, const schema::Sample& sample) {
  return measure == Measure::a2 ? sample.a2 : measure == Measure::a3 ? sample.a3 : sample.a4;
}

std::vector<double> laguerre_series(const Quantity& quantity, const Samples& samples) {
  std::vector<double> values;
  for (const schema::Sample& sample : samples)
    if (const auto value = laguerre(quantity.measure, sample)) values.push_back(*value);
  return values;
}

std::optional<double> mean_laguerre(const Quantity& quantity, const Samples& samples) {
  const auto values = laguerre_series(quantity, within(samples, quantity.from, quantity.to));
  if (values.empty() || !reaches(samples, quantity.to)) return std::nullopt;
  return analysis::estimate(values).mean;
}

std::optional<double> decay_rate(const Quantity& quantity, const schema::Job& job,
                                 const Samples& samples) {
  const Samples window = within(samples, quantity.from, quantity.to);
  if (window.size() < 2 || !reaches(samples, quantity.to)) return std::nullopt;
  if (!cools_by_haff(job) || *job.e >= 1) return std::nullopt;
  const schema::Sample &first = window.front(), &last = window.back();
  if (!first.temperature || !last.temperature) return std::nullopt;
  return analysis::gamma_ratio(*first.temperature, *last.temperature, last.tau - first.tau, *job.e,
                               job.d);
}

std::optional<double> ln_temperature(double tau, int d, const Samples& samples) {
  if (!reaches(samples, tau)) return std::nullopt;
  std::vector<double> at, logarithm;
  for (const schema::Sample& sample : samples) {
    if (!sample.temperature) return std::nullopt;
    at.push_back(sample.tau);
    logarithm.push_back(std::log(*sample.temperature / analysis::initial_temperature(d)));
  }
  return analysis::interpolated(at, logarithm, std::min(tau, at.back()));
}

std::optional<double> crossover(const schema::Job& job, const FinishedRun& run, std::size_t every) {
  if (every == 1 || !cools_by_haff(job)) return run.tau_c;
  std::vector<double> tau, temperature;
  for (const schema::Sample& sample : every_so_manieth(run.samples, every)) {
    if (!sample.temperature) return std::nullopt;
    tau.push_back(sample.tau);
    temperature.push_back(*sample.temperature);
  }
  return analysis::tau_c(tau, temperature, *job.e, job.d);
}

std::optional<double> correlation(const Quantity& quantity, const FinishedRun& run) {
  for (const schema::Profile& profile : run.correlations) {
    if (std::abs(profile.tau - quantity.to) > rounding) continue;
    return analysis::interpolated(profile.x, profile.value, quantity.r);
  }
  return std::nullopt;
}

}  // namespace

Quantity usual_quantity(Measure measure, double tau) {
  if (is_laguerre(measure)) return {.measure = measure, .from = plateau_from, .to = plateau_to};
  switch (measure) {
    case Measure::tau_c:
      return {.measure = measure};
    case Measure::gamma_ratio:
      return {.measure = measure, .from = tau - decay_reach, .to = tau + decay_reach};
    case Measure::correlation:
      return {.measure = measure, .from = tau, .to = tau, .r = correlation_r};
    default:
      return {.measure = measure, .from = tau, .to = tau};
  }
}

std::optional<Quantity> quantity_at(Measure measure, const std::string& window) {
  const auto colon = window.find(':');
  const auto from = number_in(window.substr(0, colon));
  if (!from || *from < 0 || measure == Measure::tau_c) return std::nullopt;
  if (colon == std::string::npos) {
    const Quantity quantity = usual_quantity(measure, *from);
    if (is_laguerre(measure) || quantity.from < 0) return std::nullopt;
    return quantity;
  }
  const auto to = number_in(window.substr(colon + 1));
  if (!to || *from >= *to || !(is_laguerre(measure) || measure == Measure::gamma_ratio))
    return std::nullopt;
  return Quantity{.measure = measure, .from = *from, .to = *to};
}

Quantity quantity_of(const schema::Target& target) {
  return {.measure = measure_named(target.quantity).value(),
          .from = target.tau_from,
          .to = target.tau_to};
}

bool is_laguerre(Measure measure) {
  return measure == Measure::a2 || measure == Measure::a3 || measure == Measure::a4;
}

std::string name(Measure measure) {
  switch (measure) {
    case Measure::a2:
      return "a2";
    case Measure::a3:
      return "a3";
    case Measure::a4:
      return "a4";
    case Measure::gamma_ratio:
      return "gamma_ratio";
    case Measure::ln_temperature:
      return "ln_temperature";
    case Measure::tau_c:
      return "tau_c";
    case Measure::correlation:
      return "G_parallel";
  }
  throw std::logic_error("unknown measure");
}

std::optional<Measure> measure_named(const std::string& text) {
  for (const Measure measure : {Measure::a2, Measure::a3, Measure::a4, Measure::gamma_ratio,
                                Measure::ln_temperature, Measure::tau_c, Measure::correlation})
    if (name(measure) == text) return measure;
  return std::nullopt;
}

std::string describe(const Quantity& quantity) {
  switch (quantity.measure) {
    case Measure::tau_c:
      return "tau_c";
    case Measure::ln_temperature:
      return fmt::format("ln T/T0, tau {:g}", quantity.to);
    case Measure::correlation:
      return fmt::format("G_parallel, r {:g}, tau {:g}", quantity.r, quantity.to);
    case Measure::gamma_ratio:
      return fmt::format("gamma/gamma0, tau {:g} to {:g}", quantity.from, quantity.to);
    default:
      return fmt::format("{}, tau {:g} to {:g}", name(quantity.measure), quantity.from,
                         quantity.to);
  }
}

Quantity middle_half(const Quantity& quantity) {
  Quantity half = quantity;
  const double quarter = (quantity.to - quantity.from) / 4;
  half.from += quarter;
  half.to -= quarter;
  return half;
}

std::optional<double> value_of(const Quantity& quantity, const schema::Job& job,
                               const FinishedRun& run, std::size_t every) {
  if (quantity.measure == Measure::tau_c) return crossover(job, run, every);
  if (quantity.measure == Measure::correlation) return correlation(quantity, run);
  const Samples samples = every_so_manieth(run.samples, every);
  if (quantity.measure == Measure::gamma_ratio) return decay_rate(quantity, job, samples);
  if (quantity.measure == Measure::ln_temperature)
    return ln_temperature(quantity.to, job.d, samples);
  return mean_laguerre(quantity, samples);
}

std::optional<OneRunError> error_within(const Quantity& quantity, const schema::Job& job,
                                        const FinishedRun& run) {
  if (!is_laguerre(quantity.measure)) return std::nullopt;
  const auto values = laguerre_series(quantity, within(run.samples, quantity.from, run.tau_max));
  if (values.size() < 2) return std::nullopt;
  const auto blocks = analysis::block_estimate(values);
  if (static_cast<double>(blocks.block_length) < long_enough * blocks.correlation_time)
    return std::nullopt;
  const double correlation_time = blocks.correlation_time * job.sample_every;
  const double times = (quantity.to - quantity.from + job.sample_every) / correlation_time;
  const double variance = std::pow(analysis::standard_deviation(analysis::estimate(values)), 2);
  return OneRunError{
      .standard_error = std::sqrt(2 * variance / times * (1 - (1 - std::exp(-times)) / times)),
      .correlation_time = correlation_time};
}

std::optional<double> half_interval(const schema::Target& target, const FinishedSeries& series) {
  std::size_t realizations = 0;
  std::vector<double> of_pilots;
  for (const FinishedRun& run : series.runs) {
    const auto value = value_of(quantity_of(target), series.job, run);
    if (!value) continue;
    ++realizations;
    if (std::ranges::count(target.pilots, run.seed) > 0) of_pilots.push_back(*value);
  }
  if (of_pilots.size() < 2 || of_pilots.size() < target.pilots.size()) return std::nullopt;
  return analysis::half_interval(analysis::estimate(of_pilots), realizations);
}

double cpu_seconds(const Quantity& quantity, const FinishedRun& run) {
  const double needed = quantity.measure == Measure::tau_c ? run.tau_c.value_or(run.tau_max)
                                                           : std::max(quantity.to, 0.0);
  return run.equilibration_cpu_seconds + run.cpu_seconds * std::min(1.0, needed / run.tau_max);
}

std::vector<double> values_of(const Quantity& quantity, const FinishedSeries& series) {
  std::vector<double> values;
  for (const FinishedRun& run : series.runs)
    if (const auto value = value_of(quantity, series.job, run)) values.push_back(*value);
  return values;
}

std::size_t unfinished(const Quantity& quantity, const FinishedSeries& series) {
  if (quantity.measure != Measure::tau_c) return 0;
  return series.runs.size() - values_of(quantity, series).size();
}

}  // namespace haff::campaign
