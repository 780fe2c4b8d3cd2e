// SPDX-License-Identifier: GPL-3.0-or-later

// A gas of 4000 inelastic spheres cools: its temperature beside Haff's law.
#include <cmath>
#include <cstdio>
#include <haff/engine/initial.hpp>
#include <haff/engine/simulation.hpp>

using namespace haff::engine;

// Granular temperature T = m <v^2> / 3; velocities come scaled by 2^exponent.
double temperature(const Simulation& gas) {
  double sum = 0;
  for (const Vector& v : gas.velocities()) sum += v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  return std::ldexp(sum / gas.particles() / 3, -2 * gas.exponent());
}

int main() {
  const double n = 0.4, e = 0.9;
  const std::uint32_t particles = 4000;
  const std::uint64_t seed = 1;

  Simulation elastic({.restitution = 1}, initial_state(n, particles, seed));
  elastic.run_to(collisions_at(50, particles));  // melts the lattice

  Simulation gas({.restitution = e}, restarted(elastic.state()));
  const double start = temperature(gas);
  std::puts("tau  T/T0       Haff");
  for (int tau = 0; tau <= 50; tau += 10) {
    gas.run_to(collisions_at(tau, particles));
    std::printf("%-3d  %.3e  %.3e\n", tau, temperature(gas) / start,
                std::exp(-(1 - e * e) / 3 * tau));
  }
}
