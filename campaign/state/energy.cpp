// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/state/energy.hpp"

#include <fmt/format.h>

#include <cmath>

#include "campaign/state/model.hpp"
#include "engine/mixture.hpp"
#include "engine/simulation.hpp"

namespace haff::campaign {
namespace {

// A sample and a checkpoint at the same tau are sums over the same velocities, in an order that may
// differ between two machines or versions. [relative]
constexpr double energy_rounding = 1e-11;

// A thermostat puts energy in at random. A gas of two particles may well get twice the mean, but
// none gets a hundred times as much.
constexpr double most_heat = 100;

// An upper bound for the energy that was put into a gas until then, as total_energy() counts it.
// [E(0)]
double energy_put_in(const engine::State& state, const schema::Job& job) {
  const double heat =
      most_heat * job.effects.parameter("thermostat", "rate").value_or(0) * state.time;
  return 2.0 / job.d * (1 + elastic_drift + heat);
}

}  // namespace

double total_energy(const schema::Sample& sample, const schema::Job& job) {
  return *sample.temperature +
         sample.rotational_temperature.value_or(0) * axes_of_rotation(job.d) / job.d;
}

double total_energy(const engine::State& state, const schema::Job& job) {
  const auto mixture = mixture_in(state);
  const auto mass_of = [&](std::uint32_t id) { return mixture ? mixture->mass_of(id) : 1; };
  double sum = 0;
  for (std::size_t i = 0; i < state.id.size(); ++i) {
    const auto& v = state.velocity[i];
    sum += mass_of(state.id[i]) * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
  const auto q = job.effects.parameter("roughness", "q");
  const auto spin = state.memory.find("spin");
  if (q && spin != state.memory.end())
    for (std::size_t i = 0; i < spin->second.size(); ++i)
      sum += mass_of(static_cast<std::uint32_t>(i / 3)) * *q * spin->second[i] * spin->second[i];
  const double components = static_cast<double>(job.d) * state.particles();
  return std::ldexp(sum / components, -2 * state.exponent);
}

bool is_heated(const schema::Job& job) {
  return job.effects.contains("thermostat");
}

std::optional<std::string> energy_contradiction(const engine::State& state, const schema::Job& job,
                                                const std::vector<schema::Sample>& samples) {
  const double energy = total_energy(state, job);
  if (!(energy >= 0 && energy <= energy_put_in(state, job)))
    return fmt::format(
        "the state after {} collisions has temperature {:.17g}, more than was ever "
        "put in",
        state.collisions, energy);
  for (const schema::Sample& sample : samples) {
    if (!sample.temperature) continue;
    const std::int64_t collisions = engine::collisions_at(sample.tau, job.particles);
    if (collisions != state.collisions && is_heated(job)) continue;
    const double sampled = total_energy(sample, job);
    const double excess = energy - sampled;
    const double rounding = energy_rounding * sampled + smallest_energy;
    const bool agrees = collisions < state.collisions   ? excess <= rounding
                        : collisions > state.collisions ? excess >= -rounding
                                                        : std::abs(excess) <= rounding;
    if (agrees) continue;
    return fmt::format(
        "the state after {} collisions has temperature {:.17g}, the sample at tau = "
        "{} {:.17g}",
        state.collisions, energy, sample.tau, sampled);
  }
  return std::nullopt;
}

}  // namespace haff::campaign
