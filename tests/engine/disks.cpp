// SPDX-License-Identifier: GPL-3.0-or-later

// Disks: they stay in their plane, keep the same promises as spheres, and have the right pressure.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "engine/initial.hpp"
#include "engine/soundness.hpp"
#include "support/gas.hpp"

using namespace haff::engine;
using haff::tests::distance;

namespace {

constexpr std::uint32_t disks = 500;

std::int64_t at(double tau) {
  return collisions_at(tau, disks);
}

bool flat(const State& state) {
  for (std::size_t i = 0; i < state.position.size(); ++i)
    if (state.position[i][2] != 0 || state.velocity[i][2] != 0) return false;
  return true;
}

void is_sound(const State& state, double n, std::uint32_t particles) {
  CAPTURE(n);
  REQUIRE(state.d == 2);
  REQUIRE(state.particles() == particles);
  CHECK(flat(state));
  CHECK(state.box * state.box * n / particles == doctest::Approx(1).epsilon(1e-15));
  double nearest = state.box;
  double energy = 0;
  for (std::size_t i = 0; i < particles; ++i) {
    energy += 0.5 * dot(state.velocity[i], state.velocity[i]);
    for (std::size_t j = 0; j < i; ++j)
      nearest = std::min(nearest, distance(state.position[i], state.position[j], state.box));
  }
  CHECK(nearest > 1 - 1e-12);  // rounding in the last step of growth
  CHECK(energy / particles == doctest::Approx(1).epsilon(1e-13));
}

}  // namespace

TEST_CASE("disks: they start on a lattice if it fits, and are grown otherwise") {
  is_sound(initial_state(0.4, 500, 1, 2), 0.4, 500);
  is_sound(initial_state(0.05, 2, 1, 2), 0.05, 2);
  is_sound(initial_state(1.1, 56 * 97 / 4, 1, 2), 1.1, 56 * 97 / 4);
  is_sound(initial_state(0.6, 3, 1, 2), 0.6, 3);  // a box of 2.2 sigma
  is_sound(initial_state(1.0, 90, 1, 2), 1.0, 90);
}

TEST_CASE("disks: the bits do not depend on stops, observations, or SIMD") {
  for (const double e : {1.0, 0.8, 0.5}) {
    Simulation whole({.restitution = e}, initial_state(0.4, disks, 3, 2));
    Simulation scalar({.restitution = e}, initial_state(0.4, disks, 3, 2), SearchBackend::scalar);
    whole.run_to(at(10));
    Simulation continued({.restitution = e}, whole.state());
    for (const double tau : {13.0, 20.0, 40.0}) {
      whole.run_to(at(tau));
      continued.run_to(at(tau));
      scalar.run_to(at(tau));
      REQUIRE(whole.velocities() == continued.velocities());
      REQUIRE(whole.positions() == scalar.positions());
      REQUIRE(whole.time() == continued.time());
    }
    CHECK(whole.state() == continued.state());
    CHECK(whole.state() == scalar.state());
    CHECK(flat(whole.state()));
  }
}

TEST_CASE("disks: a disk that leaves its plane is named") {
  State state = initial_state(0.4, 20, 1, 2);
  state.velocity[4][2] = 1e-3;
  const auto wrong = unsoundness(state);
  REQUIRE(wrong);
  CHECK(wrong->find("disk " + std::to_string(state.id[4]) + " has left its plane") == 0);
  CHECK_THROWS_AS(Simulation({}, state), std::invalid_argument);
}

TEST_CASE("disks: overlapping disks are found wherever they are") {
  for (const std::uint32_t particles : {20u, 2000u}) {
    State state = initial_state(0.4, particles, 1, 2);
    state.position[1] = state.position[0];
    state.position[1][0] += state.position[1][0] < 1 ? 0.75 : -0.75;
    REQUIRE(unsoundness(state));
    CHECK(unsoundness(state)->find("overlap by 0.25") != std::string::npos);
  }
}

// Z = 1 + 2 phi chi, omega_0 = 2 n chi sqrt(pi T / m), chi = (1 - 7 phi/16) / (1 - phi)^2: D.
// Henderson, Mol. Phys. 30, 971 (1975). 4e5 collisions give the virial to 0.2 % and the rate to
// 0.1 %; the formula is good to 0.3 % up to phi = 0.5. tests/validate/disks.cpp has slower and more
// precise tests.
TEST_CASE("disks: pressure and collision rate of the elastic fluid are Henderson's") {
  constexpr std::uint32_t particles = 2000;
  constexpr double n = 0.4;
  constexpr double tolerance = 0.01;
  const double phi = std::numbers::pi * n / 4;
  const double chi = (1 - 7 * phi / 16) / ((1 - phi) * (1 - phi));
  Simulation gas({.restitution = 1}, initial_state(n, particles, 1, 2));
  gas.run_to(collisions_at(50, particles));
  gas.take_tally();
  const double start = gas.time();
  gas.run_to(collisions_at(250, particles));
  const double duration = gas.time() - start;
  constexpr double temperature = 1;  // E = (d/2) T
  const double z = 1 + gas.take_tally().virial / (2 * particles * temperature * duration);
  CHECK(z == doctest::Approx(1 + 2 * phi * chi).epsilon(tolerance));
  const double rate = 2 * n * chi * std::sqrt(std::numbers::pi * temperature);
  CHECK(200 / duration == doctest::Approx(rate).epsilon(tolerance));
}
