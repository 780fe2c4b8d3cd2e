// SPDX-License-Identifier: GPL-3.0-or-later

// States made by hand, and what tests ask of a gas.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/collision/pair_geometry.hpp"
#include "engine/simulation.hpp"

namespace haff::tests {

// Particles 0, 1, 2, ... at these places with these velocities.
inline engine::State state_of(double box, std::vector<engine::Vector> positions,
                              std::vector<engine::Vector> velocities) {
  engine::State state;
  state.box = box;
  for (std::uint32_t id = 0; id < positions.size(); ++id) state.id.push_back(id);
  state.position = std::move(positions);
  state.velocity = std::move(velocities);
  return state;
}

// Kinetic energy of all particles, in true units.
inline double energy(const engine::Simulation& gas) {
  double sum = 0;
  for (const engine::Vector& v : gas.velocities()) sum += 0.5 * engine::dot(v, v);
  return std::ldexp(sum, -2 * gas.exponent());
}

inline engine::Vector momentum(const engine::Simulation& gas) {
  engine::Vector sum{};
  for (const engine::Vector& v : gas.velocities())
    for (std::size_t k = 0; k < 3; ++k) sum[k] += v[k];
  return sum;
}

// |sum of m v| in units of sqrt(N) sqrt(m T).
inline double relative_momentum(const engine::Simulation& gas) {
  const engine::Vector sum = momentum(gas);
  const double temperature =
      2.0 / 3 * std::ldexp(energy(gas), 2 * gas.exponent()) / gas.particles();
  return std::sqrt(engine::dot(sum, sum) / (gas.particles() * temperature));
}

// Distance of the nearest images.
inline double distance(const engine::Vector& a, const engine::Vector& b, double box) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double r = b[k] - a[k];
    r -= std::nearbyint(r / box) * box;
    sum += r * r;
  }
  return std::sqrt(sum);
}

// Z = p / (n T) of an elastic gas, from its virial between now and `tau` collisions per particle
// later.
inline double compressibility(engine::Simulation& gas, double tau) {
  gas.take_tally();
  const double before = gas.time();
  gas.run_to(gas.collisions() + engine::collisions_at(tau, gas.particles()));
  const double temperature = 2.0 / 3 * energy(gas) / gas.particles();
  return 1 + gas.take_tally().virial / (3 * gas.particles() * temperature * (gas.time() - before));
}

}  // namespace haff::tests
