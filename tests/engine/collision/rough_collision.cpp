// SPDX-License-Identifier: GPL-3.0-or-later

// Rough spheres: conservation laws, the naive reference, restarts, and the smooth limit.
#include "engine/collision/rough_collision.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "engine/initial.hpp"
#include "engine/restitution/restitution_models.hpp"
#include "engine/simulation.hpp"
#include "support/gas.hpp"
#include "support/reference.hpp"

using namespace haff;
using namespace haff::engine;

namespace {

Model rough(double e, double beta, double q = 0.4) {
  return {.restitution = e, .effects = {{"roughness", {{"beta", beta}, {"q", q}}}}};
}

// A state with spins, whose energy equals that of the velocities at q = 2/5.
State spinning(double n, std::uint32_t particles, std::uint64_t seed, int d = 3) {
  State state = initial_state(n, particles, seed, d);
  auto& spin = state.memory["spin"];
  for (const Vector& v : state.velocity)
    for (const double x : {d == 3 ? v[1] : 0, -v[2], v[0]}) spin.push_back(x * std::sqrt(2.5));
  return state;
}

void agrees(const Model& model, const State& start, double tau, SearchBackend prediction) {
  CAPTURE(start.particles());
  Simulation gas(model, start, prediction);
  tests::ReferenceOf<RoughCollision<>> reference(RoughCollision<>(model), model, start);
  for (std::int64_t c = 1; c <= collisions_at(tau, start.particles()); ++c) {
    gas.run_to(c);
    reference.step();
    CAPTURE(c);
    REQUIRE(gas.time() == reference.time());
    REQUIRE(gas.velocities() == reference.velocities());
    REQUIRE(gas.rotational_energy().value() == reference.rotational_energy());
    if (gas.synchronized()) REQUIRE(gas.state() == reference.state());
  }
}

struct Pair {
  Particle a{{0, 0, 0}, 0, {0.3, -0.2, 0.5}, 0, 0};
  Particle b{{0.6, 0, 0.8}, 0, {-0.7, 0.1, -0.4}, 1, 0};
  std::vector<double> spin{0.2, -1.1, 0.4, 0.9, 0.3, -0.6};
  Box box{10};
  Clock clock;

  Vector w(std::size_t i) const { return {spin[3 * i], spin[3 * i + 1], spin[3 * i + 2]}; }
  void collide(const Model& model) {
    RoughCollision<> physics(model);
    State state;
    state.id = {0, 1};
    state.memory["spin"] = spin;
    physics.recall(state);
    physics.collide(a, b, 0, box, clock);
    state.memory.clear();
    physics.store(state);
    spin = state.memory["spin"];
  }
  double energy(double q) const {
    return 0.5 * (dot(a.velocity, a.velocity) + dot(b.velocity, b.velocity) +
                  q * (dot(w(0), w(0)) + dot(w(1), w(1))));
  }
  // Orbital angular momentum, and that of spin, I omega = (q/2) w.
  Vector angular_momentum(double q) const {
    const Vector of_a = cross(a.position, a.velocity), of_b = cross(b.position, b.velocity);
    Vector sum;
    for (std::size_t k = 0; k < 3; ++k) sum[k] = of_a[k] + of_b[k] + 0.5 * q * (w(0)[k] + w(1)[k]);
    return sum;
  }
  // The velocity of the surface of a relative to that of b, at the contact.
  Vector surface_velocity() const {
    Vector spins, g;
    for (std::size_t k = 0; k < 3; ++k) spins[k] = w(0)[k] + w(1)[k];
    const Vector turning = cross(spins, b.position);
    for (std::size_t k = 0; k < 3; ++k) g[k] = a.velocity[k] - b.velocity[k] + turning[k];
    return g;
  }
};

// The error of sums of a few numbers of order one.
constexpr double rounding = 1e-14;

}  // namespace

TEST_CASE("rough spheres: a collision reverses the surfaces' velocity by e and beta") {
  for (const double beta : {-1.0, -0.3, 0.0, 0.7, 1.0}) {
    CAPTURE(beta);
    Pair pair;
    const Vector n = pair.b.position;
    const Vector before = pair.surface_velocity();
    pair.collide(rough(0.8, beta, 0.3));
    const Vector after = pair.surface_velocity();
    CHECK(std::abs(dot(after, n) + 0.8 * dot(before, n)) < rounding);
    const Vector g_t = cross(n, before), g_t_after = cross(n, after);
    for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(g_t_after[k] + beta * g_t[k]) < rounding);
  }
}

TEST_CASE("rough spheres: both momenta are conserved, and energy falls by the counted loss") {
  for (const double q : {0.1, 0.4, 1.0})
    for (const double beta : {-1.0, -0.5, 0.5, 1.0}) {
      CAPTURE(q);
      CAPTURE(beta);
      Pair pair;
      const double energy = pair.energy(q);
      const Vector turning = pair.angular_momentum(q);
      const Vector momentum{pair.a.velocity[0] + pair.b.velocity[0],
                            pair.a.velocity[1] + pair.b.velocity[1],
                            pair.a.velocity[2] + pair.b.velocity[2]};
      pair.collide(rough(0.7, beta, q));
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(std::abs(pair.a.velocity[k] + pair.b.velocity[k] - momentum[k]) < rounding);
        CHECK(std::abs(pair.angular_momentum(q)[k] - turning[k]) < rounding);
      }
      CHECK(std::abs(energy - pair.energy(q) - pair.clock.tally.dissipated) < rounding);
    }
}

TEST_CASE("rough spheres equal the reference") {
  for (const double beta : {-0.5, 0.5}) {
    agrees(rough(0.8, beta), spinning(0.4, 88, 7), 11, SearchBackend::simd);
    agrees(rough(0.6, beta), spinning(0.5, 8, 3), 40, SearchBackend::simd);
  }
  Model tc = rough(0.8, 0.5);
  tc.law = {"tc", {{"t_c", 0.02}}};
  agrees(tc, spinning(0.4, 88, 7), 11, SearchBackend::scalar);
}

TEST_CASE("rough disks equal the reference, and stay in their plane") {
  for (const SearchBackend prediction : {SearchBackend::simd, SearchBackend::scalar})
    agrees(rough(0.8, 0.5, 0.5), spinning(0.4, 80, 7, 2), 11, prediction);
  agrees(rough(0.6, -0.5, 0.5), spinning(0.5, 8, 3, 2), 40, SearchBackend::simd);
  Model shaken = rough(0.8, 0.5, 0.5);
  shaken.effects["shuffle"] = {{"every", 2}};
  shaken.effects["thermostat"] = {{"rate", 0.1}};
  agrees(shaken, spinning(0.4, 80, 7, 2), 11, SearchBackend::simd);

  Simulation gas(rough(0.8, 0.5, 0.5), spinning(0.4, 80, 7, 2));
  gas.run_to(collisions_at(10, 80));
  const State state = gas.state();
  for (std::size_t i = 0; i < 80; ++i) {
    CHECK(state.memory.at("spin")[3 * i] == 0);
    CHECK(state.memory.at("spin")[3 * i + 1] == 0);
  }
  State tilted = state;
  tilted.memory["spin"][4] = 1;
  CHECK_THROWS_WITH_AS(Simulation(rough(0.8, 0.5, 0.5), tilted),
                       "the state has disks that rotate about an axis in their plane",
                       std::invalid_argument);
}

TEST_CASE("rough spheres: with beta = -1 they move like smooth spheres") {
  const State start = spinning(0.4, 500, 1);
  Simulation smooth({.restitution = 0.8}, start);
  Simulation gas(rough(0.8, -1), start);
  smooth.run_to(collisions_at(40, 500));
  gas.run_to(collisions_at(40, 500));
  CHECK(smooth.velocities() == gas.velocities());
  // No collision changes the spins, and scaling is exact.
  CHECK(std::ldexp(gas.rotational_energy().value(), -2 * gas.exponent()) ==
        doctest::Approx(1).epsilon(1e-12));
  CHECK_FALSE(smooth.rotational_energy().has_value());
}

TEST_CASE("rough spheres: perfectly rough, elastic spheres conserve the sum of both energies") {
  Simulation gas(rough(1, 1), initial_state(0.4, 500, 1));
  gas.run_to(collisions_at(50, 500));
  const double translation = tests::energy(gas) / 500;
  const double rotation = std::ldexp(gas.rotational_energy().value(), -2 * gas.exponent());
  // Each of 12 500 collisions rounds them by about 1e-16 of a particle's share.
  CHECK(std::abs(translation + rotation - 1) < 1e-12);
  CHECK(rotation > 0.4);  // spins start at rest
  CHECK(gas.invariants().energy_mismatch < 1e-13);
}

TEST_CASE("rough spheres: a run continued from its state is the same run") {
  for (const double beta : {-0.5, 0.8}) {
    Simulation whole(rough(0.7, beta), initial_state(0.4, 500, 3));
    whole.run_to(collisions_at(20, 500));
    Simulation continued(rough(0.7, beta), whole.state());
    CHECK(continued.rotational_energy() == whole.rotational_energy());
    for (const double tau : {23.0, 60.0}) {
      whole.run_to(collisions_at(tau, 500));
      continued.run_to(collisions_at(tau, 500));
      CHECK(whole.velocities() == continued.velocities());
      CHECK(whole.rotational_energy() == continued.rotational_energy());
    }
    CHECK(whole.state() == continued.state());
    CHECK(whole.exponent() > 0);  // spins were rescaled on the way
  }
}

TEST_CASE("rough spheres: missing parameters are named") {
  const State start = initial_state(0.4, 108, 1);
  CHECK_THROWS_WITH_AS(Simulation(rough(0.8, 1.1), start), "the model needs beta from -1 to 1",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Simulation(rough(0.8, 0, 0), start), "the model needs q > 0",
                       std::invalid_argument);
  State few = start;
  few.memory["spin"] = {1, 2, 3};
  CHECK_THROWS_WITH_AS(Simulation(rough(0.8, 0), few),
                       "the state remembers spins of other particles", std::invalid_argument);
}
