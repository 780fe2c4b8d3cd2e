// SPDX-License-Identifier: GPL-3.0-or-later

// Initial states: no overlap, unit energy, no momentum, a function of (n, N, seed).
#include "engine/initial.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "engine/collision/pair_geometry.hpp"
#include "engine/particles/synchronize.hpp"
#include "engine/simulation.hpp"

using namespace haff::engine;

namespace {

double smallest_distance(const State& state) {
  double smallest = state.box;
  for (std::size_t i = 0; i < state.position.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      Vector r;
      for (std::size_t k = 0; k < 3; ++k) {
        r[k] = state.position[i][k] - state.position[j][k];
        r[k] -= std::nearbyint(r[k] / state.box) * state.box;
      }
      smallest = std::min(smallest, std::sqrt(dot(r, r)));
    }
  return smallest;
}

void is_sound(const State& state, std::uint32_t particles) {
  REQUIRE(state.particles() == particles);
  CHECK(smallest_distance(state) > 1 - 1e-12);  // rounding in the last step of growth
  double energy = 0;
  Vector momentum{};
  for (const Vector& v : state.velocity) {
    energy += 0.5 * dot(v, v);
    for (std::size_t k = 0; k < 3; ++k) momentum[k] += v[k];
  }
  // Sums of N terms of size one round by less than N times 2^-53.
  const double rounding = particles * 0x1p-52;
  CHECK(std::abs(energy / particles - 1) < rounding);
  CHECK(std::sqrt(dot(momentum, momentum)) < particles * rounding);
  for (const Vector& r : state.position)
    for (const double x : r) CHECK((x >= 0 && x < state.box));
}

}  // namespace

TEST_CASE("spheres start on a lattice if it fits") {
  is_sound(initial_state(0.4, 500, 1), 500);
  is_sound(initial_state(0.05, 2, 1), 2);
  is_sound(initial_state(1.2, 500, 1), 500);  // 500 = 4 * 5^3; far above freezing
}

TEST_CASE("spheres are grown where no lattice fits") {
  is_sound(initial_state(0.5, 8, 3), 8);      // a box smaller than four cells
  is_sound(initial_state(1.1, 300, 1), 300);  // phi = 0.58
}

TEST_CASE("spheres that jam while they grow are refused") {
  CHECK_THROWS_WITH_AS(initial_state(1.38, 33, 1), doctest::Contains("jammed"),
                       std::invalid_argument);
}

TEST_CASE("an initial state depends on the seed and on nothing else") {
  CHECK(initial_state(0.4, 300, 5) == initial_state(0.4, 300, 5));
  CHECK(initial_state(0.4, 300, 5).velocity != initial_state(0.4, 300, 6).velocity);
  CHECK(initial_state(1.1, 100, 5) == initial_state(1.1, 100, 5));
}

TEST_CASE("restarted: unit energy, clocks at zero, same positions") {
  Simulation gas({.restitution = 0.7}, initial_state(0.4, 108, 1));
  gas.run_to(collisions_at(2 * synchronization_period, 108));
  const State before = gas.state();
  const State after = restarted(before);
  is_sound(after, 108);
  CHECK(after.position == before.position);
  CHECK(after.collisions == 0);
  CHECK(after.time == 0);
  CHECK(after.exponent == 0);
}

TEST_CASE("the box has the volume that the density asks for") {
  for (const double n : {1e-4, 0.05, 0.4, 1.4}) {
    const double side = initial_state(n, 32, 1).box;
    // A few rounding errors of the cube root and of its cube.
    CHECK(side * side * side * n / 32 == doctest::Approx(1).epsilon(4e-15));
  }
}
