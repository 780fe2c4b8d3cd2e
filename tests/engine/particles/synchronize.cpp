// SPDX-License-Identifier: GPL-3.0-or-later

// The checks and corrections of a synchronization, one at a time.
#include "engine/particles/synchronize.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "engine/simulation.hpp"
#include "engine/soundness.hpp"

using namespace haff::engine;

namespace {

std::vector<Particle> two_that_part() {
  std::vector<Particle> particles(2);
  particles[0].velocity = {0.5, -0.25, 1};
  particles[1].velocity = {-0.5, 0.25, -1};
  return particles;
}

}  // namespace

TEST_CASE("synchronize: a wrapped position lies in the box, however near to a face") {
  const Box box(7.3);
  const double below = -1e-20;  // one box farther it is the far face itself, by rounding
  for (const double x : {below, -0.0, 0.0, 7.3, -7.3, 7.3 - 1e-16, 3 * 7.3 + 1, -1e9}) {
    CAPTURE(x);
    const Vector at = wrapped({x, x, x}, box);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(at[k] >= 0);
      CHECK(at[k] < box.side);
    }
  }
}

TEST_CASE("synchronize: a change of energy without a collision is found") {
  std::vector<Particle> particles = two_that_part();
  Clock clock;
  start(particles, clock);
  audit(particles, clock, 1);
  CHECK(clock.invariants.energy_mismatch == 0);
  // A part in 10^9 of a velocity changes the energy by a hundred times the allowed amount.
  for (double& v : particles[0].velocity) v *= 1 + 1e-9;
  CHECK_THROWS_AS(audit(particles, clock, 1), PhysicsError);
  CHECK(clock.invariants.energy_mismatch > allowed_energy_mismatch);
}
