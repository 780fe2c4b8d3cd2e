// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/measurement.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "analysis/observables/equilibrium.hpp"
#include "analysis/observables/moments.hpp"
#include "analysis/observables/species.hpp"
#include "analysis/theory/cooling.hpp"
#include "campaign/job/asked.hpp"
#include "campaign/state/model.hpp"
#include "engine/initial.hpp"

namespace haff::campaign {
namespace {

std::optional<double> if_finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// The mean over the time since the last of the earlier rows, which has a temperature.
double mean_temperature(std::span<const schema::Sample> earlier, const schema::Sample& now) {
  constexpr std::size_t useful = 3;  // beside this row: analysis::mean_temperature uses four
  std::vector<double> time, temperature;
  for (const schema::Sample& row : earlier.last(std::min(useful, earlier.size()))) {
    if (!row.temperature) continue;
    time.push_back(row.time);
    temperature.push_back(*row.temperature);
  }
  time.push_back(now.time);
  temperature.push_back(*now.temperature);
  return analysis::mean_temperature(time, temperature);
}

// The columns that are averages over the interval since the row before.
void measure_interval(schema::Sample& sample, double virial, double collisions,
                      const schema::Job& job, std::span<const schema::Sample> earlier) {
  if (earlier.empty() || !earlier.back().temperature) return;
  const schema::Sample& previous = earlier.back();
  const double elapsed = sample.time - previous.time;
  if (cools_by_haff(job))
    sample.gamma_ratio = if_finite(analysis::gamma_ratio(*previous.temperature, *sample.temperature,
                                                         sample.tau - previous.tau, *job.e, job.d));
  sample.collision_rate = if_finite(analysis::collision_rate(collisions, job.particles, elapsed));
  sample.pressure = if_finite(analysis::pressure(job.n, mean_temperature(earlier, sample), virial,
                                                 job.particles, elapsed, job.d));
}

void measure_species(schema::Sample& sample, const engine::Simulation& gas,
                     const engine::Mixture& mixture, const schema::Job& job) {
  std::vector<bool> is_second;
  for (const std::uint32_t id : gas.ids()) is_second.push_back(mixture.is_second(id));
  const auto temperature =
      analysis::species_temperatures(gas.velocities(), is_second, {1, mixture.mass}, job.d);
  sample.temperature_1 = std::ldexp(temperature[0], -2 * gas.exponent());
  sample.temperature_2 = std::ldexp(temperature[1], -2 * gas.exponent());
}

void measure_laguerre(schema::Sample& sample, const analysis::LaguerreCoefficients& a) {
  sample.a2 = if_finite(a[2]);
  sample.a3 = if_finite(a[3]);
  sample.a4 = if_finite(a[4]);
  sample.a5 = if_finite(a[5]);
  sample.a6 = if_finite(a[6]);
}

}  // namespace

schema::Sample measure_moment(const engine::Simulation& gas, const schema::Job& job, double tau) {
  schema::Sample sample{.tau = tau, .time = gas.time()};
  if (!asks_for(job, "temperature") && !asks_for(job, "laguerre")) return sample;

  const auto mixture = mixture_of(job);
  const analysis::Moments moments = analysis::moments(weighted_velocities(gas, mixture), job.d);
  if (asks_for(job, "temperature")) {
    sample.temperature = std::ldexp(moments.temperature, -2 * gas.exponent());
    if (const auto energy = gas.rotational_energy())
      sample.rotational_temperature =
          std::ldexp(*energy * 2 / axes_of_rotation(job.d), -2 * gas.exponent());
    if (mixture) measure_species(sample, gas, *mixture, job);
  }
  if (asks_for(job, "laguerre")) measure_laguerre(sample, moments.laguerre);
  return sample;
}

schema::Sample measure(engine::Simulation& gas, const schema::Job& job, double tau,
                       std::span<const schema::Sample> earlier) {
  schema::Sample sample = measure_moment(gas, job, tau);
  const engine::Tally tally = gas.take_tally();
  if (!sample.temperature || earlier.empty()) return sample;
  const std::int64_t collisions =
      gas.collisions() - engine::collisions_at(earlier.back().tau, job.particles);
  measure_interval(sample, tally.virial, static_cast<double>(collisions), job, earlier);
  return sample;
}

schema::Results results(const std::vector<schema::Sample>& samples, const schema::Job& job) {
  if (!cools_by_haff(job)) return {};
  std::vector<double> tau;
  std::vector<double> temperature;
  for (const schema::Sample& sample : samples) {
    if (!sample.temperature) return {};
    tau.push_back(sample.tau);
    temperature.push_back(*sample.temperature);
  }
  const auto tau_c = analysis::tau_c(tau, temperature, *job.e, job.d);
  if (!tau_c) return {};

  const auto after = std::lower_bound(
      samples.begin(), samples.end(), *tau_c,
      [](const schema::Sample& sample, double wanted) { return sample.tau < wanted; });
  if (after == samples.begin() || after == samples.end()) return {tau_c, std::nullopt};
  const schema::Sample& left = *(after - 1);
  const double part = (*tau_c - left.tau) / (after->tau - left.tau);
  return {tau_c, left.time + part * (after->time - left.time)};
}

bool is_equilibrated(const schema::Sample& sample, const schema::Job& job) {
  return analysis::is_equilibrated({sample.a2, sample.a3, sample.a4}, job.particles, job.d);
}

}  // namespace haff::campaign
