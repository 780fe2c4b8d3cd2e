// SPDX-License-Identifier: GPL-3.0-or-later

// The collision rate of a very dilute gas: cells are wide, and a particle passes many others before
// it collides. Under sanitizers it would take five minutes, on paths that the corner "cells of a
// very dilute gas adapt" also takes, so it is left out there (CMakePresets.json).
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "engine/initial.hpp"
#include "engine/simulation.hpp"

using namespace haff;
using engine::Simulation;

TEST_CASE("corner: the rate of a very dilute gas") {
  constexpr double n = 1e-4;
  constexpr std::uint32_t particles = 2000;
  Simulation gas({.restitution = 1}, engine::initial_state(n, particles, 1));
  gas.run_to(engine::collisions_at(50, particles));
  const double before = gas.time();
  gas.run_to(engine::collisions_at(100, particles));
  // Boltzmann's rate is 4 sqrt(pi T) n; 5e4 collisions have 0.45 % of noise: four standard errors.
  const double rate = 50 / (gas.time() - before);
  CHECK(rate / (4 * std::sqrt(std::numbers::pi * 2 / 3) * n) == doctest::Approx(1).epsilon(0.018));
}
