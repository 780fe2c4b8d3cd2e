// SPDX-License-Identifier: GPL-3.0-or-later

// The promises of a simulation: conservation, the same bits however it is run, exact scaling.
#include "engine/simulation.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "engine/collision/pair_geometry.hpp"
#include "engine/initial.hpp"
#include "engine/soundness.hpp"

using namespace haff::engine;

namespace {

constexpr std::uint32_t particles = 500;

std::int64_t at(double tau) {
  return collisions_at(tau, particles);
}

double energy(const std::vector<Vector>& velocities) {
  double sum = 0;
  for (const Vector& v : velocities) sum += 0.5 * dot(v, v);
  return sum;
}

}  // namespace

TEST_CASE("elastic spheres conserve energy and momentum") {
  Simulation gas({.restitution = 1}, initial_state(0.4, particles, 1));
  gas.run_to(at(200));
  const auto velocities = gas.velocities();
  // Each of 50 000 collisions rounds the energy by about 2^-53 of a particle's share.
  CHECK(std::abs(energy(velocities) / particles - 1) < 1e-13);
  Vector momentum{};
  for (const Vector& v : velocities)
    for (std::size_t k = 0; k < 3; ++k) momentum[k] += v[k];
  CHECK(std::sqrt(dot(momentum, momentum)) < 1e-12 * std::sqrt(particles * 2.0 / 3));
  CHECK(gas.take_tally().dissipated == 0);
}

TEST_CASE("the loss summed over collisions is the change of kinetic energy") {
  Simulation gas({.restitution = 0.8}, initial_state(0.4, particles, 1));
  gas.run_to(at(45));
  const double now = std::ldexp(energy(gas.velocities()), -2 * gas.exponent());
  // Rounding: some 1e4 terms.
  CHECK(particles - now == doctest::Approx(gas.take_tally().dissipated).epsilon(1e-11));
  CHECK(gas.take_tally().dissipated == 0);  // the tally was taken
}

TEST_CASE("a run stops exactly at the given collision") {
  Simulation gas({.restitution = 0.9}, initial_state(0.4, particles, 1));
  for (const std::int64_t collisions : {1, 2, 1000, 2499, 2500, 2501}) {
    gas.run_to(collisions);
    CHECK(gas.collisions() == collisions);
    CHECK(gas.synchronized() == (collisions == 2500));
  }
  gas.run_to(5);  // in the past: no event happens
  CHECK(gas.collisions() == 2501);
  CHECK_THROWS_AS(gas.state(), std::logic_error);
}

TEST_CASE("the trajectory does not depend on where it is observed") {
  const State start = initial_state(0.4, particles, 1);
  Simulation once({.restitution = 0.8}, start);
  once.run_to(at(40));
  Simulation often({.restitution = 0.8}, start);
  for (std::int64_t collisions = 0; collisions <= at(40); collisions += 37) {
    often.run_to(collisions);
    (void)often.positions();
  }
  often.run_to(at(40));
  CHECK(once.state() == often.state());
}

TEST_CASE("a simulation continued from its state is the same simulation") {
  for (const double e : {1.0, 0.9, 0.5})
    for (const double n : {0.01, 0.4, 1.0}) {
      CAPTURE(e);
      CAPTURE(n);
      Simulation whole({.restitution = e}, initial_state(n, particles, 3));
      whole.run_to(at(10));
      Simulation continued({.restitution = e}, whole.state());
      for (const double tau : {13.0, 20.0, 40.0}) {
        whole.run_to(at(tau));
        continued.run_to(at(tau));
        REQUIRE(whole.velocities() == continued.velocities());
        REQUIRE(whole.positions() == continued.positions());
        REQUIRE(whole.time() == continued.time());
      }
      CHECK(whole.state() == continued.state());
    }
}

TEST_CASE("SIMD and scalar search give the same bits") {
  for (const std::uint32_t count : {500u, 4000u, 20'000u}) {
    CAPTURE(count);
    const State start = initial_state(0.4, count, 2);
    Simulation simd({.restitution = 0.7}, start, SearchBackend::simd);
    Simulation scalar({.restitution = 0.7}, start, SearchBackend::scalar);
    simd.run_to(collisions_at(10, count));
    scalar.run_to(collisions_at(10, count));
    CHECK(simd.state() == scalar.state());
  }
}

TEST_CASE("after cooling by many decades numbers are near one, and time still grows") {
  Simulation gas({.restitution = 0.5}, initial_state(0.2, 64, 1));
  double time = 0;
  for (int tau = 10; tau <= 300; tau += 10) {
    gas.run_to(collisions_at(tau, 64));
    CHECK(gas.time() > time);
    time = gas.time();
    const double scaled = energy(gas.velocities()) / 64;
    CHECK(scaled >= 0.25);
    CHECK(scaled <= 1);
  }
  CHECK(gas.exponent() > 20);
}

TEST_CASE("a gas in which no particle moves cannot be run") {
  State still = initial_state(0.4, 108, 1);
  for (Vector& v : still.velocity) v = {0, 0, 0};
  Simulation gas({.restitution = 1}, still);
  CHECK_THROWS_AS(gas.run_to(1), PhysicsError);
}

// ---- stops at a time --------------------------------------------------------------------------

namespace {

// The state of a gas with these effects after tau = 25, observed this many times on the way.
State after_looks(const Model& model, int d, const Threads& threads, int looks) {
  Simulation gas(model, initial_state(d == 2 ? 0.4 : 0.3, 1000, 1, d, model.effects),
                 SearchBackend::simd, threads);
  const std::int64_t end = collisions_at(25, 1000);
  for (int k = 0; k < looks; ++k) {
    const double time = 0.013 * k;
    if (!gas.run_to(end, time)) break;
    CHECK(gas.time() == doctest::Approx(time).epsilon(1e-12));
    CHECK(gas.snapshot().time == gas.time());
  }
  gas.run_to(collisions_at(30, 1000));
  return gas.state();
}

}  // namespace

TEST_CASE("stops at times change nothing, for any gas and any number of threads") {
  const std::map<std::string, Parameters> rough{{"roughness", {{"beta", 0.5}, {"q", 0.4}}}};
  const std::map<std::string, Parameters> mixed{
      {"mixture", {{"fraction", 0.5}, {"diameter_ratio", 0.8}, {"mass_ratio", 0.1}}}};
  const std::map<std::string, Parameters> driven{{"thermostat", {{"rate", 0.05}}}};
  for (const auto& effects : {std::map<std::string, Parameters>{}, rough, mixed, driven})
    for (const int d : {2, 3})
      for (const unsigned threads : {1U, 2U}) {
        CAPTURE(d);
        CAPTURE(threads);
        const Model model{.restitution = 0.8, .law = {}, .effects = effects, .seed = 1};
        const Threads on{.count = threads};
        CHECK(after_looks(model, d, on, 2000) == after_looks(model, d, on, 0));
      }
}

TEST_CASE("a stop at a time lies between two collisions") {
  Simulation gas({.restitution = 0.8}, initial_state(0.3, particles, 1));
  REQUIRE(gas.run_to(at(20), 1.0));
  const State before = gas.snapshot();
  CHECK(before.time == 1.0);
  CHECK(before.collisions == gas.collisions());
  CHECK_FALSE(unsoundness(before));
  // In free flight until the next collision, only positions change.
  gas.run_to(before.collisions);
  CHECK(gas.time() == 1.0);
  const double later = 1.0 + 1e-9;
  REQUIRE(gas.run_to(at(20), later));
  const State after = gas.snapshot();
  REQUIRE(after.collisions == before.collisions);
  CHECK(after.velocity == before.velocity);
  for (std::size_t i = 0; i < particles; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double moved = after.position[i][k] - before.position[i][k];
      const double expected = std::ldexp(after.velocity[i][k], -after.exponent) * 1e-9;
      // The rounding error of a position in a box of 12, unless a face was crossed.
      if (std::abs(moved) < 1) CHECK(std::abs(moved - expected) < 1e-14);
    }
  // A time that has already passed means now.
  CHECK(gas.run_to(at(20), 0.5));
  CHECK(gas.time() == doctest::Approx(later).epsilon(1e-15));
  CHECK_FALSE(gas.run_to(before.collisions + 1, 1e9));
  CHECK(gas.collisions() == before.collisions + 1);
}
