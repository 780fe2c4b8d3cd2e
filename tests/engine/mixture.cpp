// SPDX-License-Identifier: GPL-3.0-or-later

// Mixtures: conservation laws, the naive reference, restarts, and equal species.
#include "engine/mixture.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "engine/actions/thermostat.hpp"
#include "engine/collision/rough_collision.hpp"
#include "engine/collision/two_species.hpp"
#include "engine/initial.hpp"
#include "engine/particles/synchronize.hpp"
#include "engine/restitution/restitution_models.hpp"
#include "engine/simulation.hpp"
#include "engine/soundness.hpp"
#include "support/reference.hpp"

using namespace haff;
using namespace haff::engine;

namespace {

Model mixed(double e, double fraction, double diameter_ratio, double mass_ratio) {
  return {.restitution = e,
          .effects = {{"mixture",
                       {{"fraction", fraction},
                        {"diameter_ratio", diameter_ratio},
                        {"mass_ratio", mass_ratio}}}}};
}

State start_of(const Model& model, double n, std::uint32_t particles, std::uint64_t seed = 1,
               int d = 3) {
  return initial_state(n, particles, seed, d, model.effects);
}

using SmoothMixture = SmoothCollision<AnyRestitutionModel, TwoSpecies>;
using RoughMixture = RoughCollision<TwoSpecies>;

SmoothMixture smooth_mixture(const Model& model, const State& start) {
  return SmoothMixture(AnyRestitutionModel(model), TwoSpecies(model, start));
}

template <class Physics>
void agrees(const Model& model, const State& start, double tau, SearchBackend prediction,
            Physics physics) {
  CAPTURE(start.particles());
  CAPTURE(start.d);
  Simulation gas(model, start, prediction);
  tests::ReferenceOf<Physics> reference(std::move(physics), model, start);
  for (std::int64_t c = 1; c <= collisions_at(tau, start.particles()); ++c) {
    gas.run_to(c);
    reference.step();
    CAPTURE(c);
    REQUIRE(gas.time() == reference.time());
    REQUIRE(gas.velocities() == reference.velocities());
    if (gas.synchronized()) REQUIRE(gas.state() == reference.state());
  }
}

// Momentum and kinetic energy of all particles, in scaled units.
struct Sums {
  Sums(const State& state) {
    const Mixture mixture = mixture_in(state).value();
    for (std::size_t i = 0; i < state.id.size(); ++i) {
      const double mass = mixture.mass_of(state.id[i]);
      for (std::size_t k = 0; k < 3; ++k) momentum[k] += mass * state.velocity[i][k];
      energy += 0.5 * mass * dot(state.velocity[i], state.velocity[i]);
    }
  }
  Vector momentum{};
  double energy = 0;
};

}  // namespace

TEST_CASE("mixture: a new gas has the right number of each species, energy 1 and no momentum") {
  const Model model = mixed(1, 0.3, 0.5, 0.1);
  const State state = start_of(model, 0.4, 1000);
  const Mixture mixture = mixture_in(state).value();
  CHECK(mixture == Mixture{.first = 700, .diameter = 0.5, .mass = 0.1});
  CHECK_FALSE(unsoundness(state));
  const Sums sums(state);
  CHECK(sums.energy == doctest::Approx(1000).epsilon(1e-12));
  CHECK(std::sqrt(dot(sums.momentum, sums.momentum)) < 1e-11);
  // Both species have one temperature: 300 particles, within four standard errors sqrt(2/900).
  double of_second = 0;
  int in_lower_half = 0;
  for (std::size_t i = 0; i < 1000; ++i)
    if (mixture.is_second(state.id[i])) {
      of_second += 0.5 * 0.1 * dot(state.velocity[i], state.velocity[i]);
      if (state.position[i][2] < 0.5 * state.box) ++in_lower_half;
    }
  CHECK(std::abs(of_second / 300 - 1) < 4 * std::sqrt(2.0 / 900));
  // Species 2 is everywhere in the box: 150 of 300 in this half, within four standard deviations.
  CHECK(std::abs(in_lower_half - 150) < 4 * std::sqrt(75.0));
}

TEST_CASE(
    "mixture: elastic mixtures conserve energy and momentum, others lose the counted energy") {
  for (const double e : {1.0, 0.8}) {
    CAPTURE(e);
    const Model model = mixed(e, 0.5, 0.4, 0.05);
    Simulation gas(model, start_of(model, 0.5, 500));
    gas.run_to(collisions_at(50, 500));
    const Sums sums(gas.state());
    const double energy = std::ldexp(sums.energy, -2 * gas.exponent());
    // Each of 12 500 collisions rounds the energy by about 1e-16 of a particle's share.
    CHECK(500 - energy - gas.take_tally().dissipated == doctest::Approx(0).epsilon(1e-9));
    CHECK(std::sqrt(dot(sums.momentum, sums.momentum)) < 1e-11);
    CHECK_FALSE(unsoundness(gas.state()));
    CHECK(gas.invariants().energy_mismatch < 1e-12);
  }
}

TEST_CASE("mixture: with equal species it is the gas of one species") {
  const Model model = mixed(0.8, 0.3, 1, 1);
  State start = initial_state(0.4, 500, 1);
  Simulation one({.restitution = 0.8}, start);
  note(mixture_of(model.effects.at("mixture"), 500), start);
  Simulation two(model, start);
  one.run_to(collisions_at(30, 500));
  two.run_to(collisions_at(30, 500));
  CHECK(one.velocities() == two.velocities());
  CHECK(one.take_tally() == two.take_tally());
}

TEST_CASE("mixtures equal the reference") {
  struct Case {
    Model model;
    double n;
    std::uint32_t particles;
    int d;
    double tau;
  };
  Model tc = mixed(0.7, 0.4, 0.6, 0.5);
  tc.law = {"tc", {{"t_c", 0.02}}};
  Model viscoelastic = mixed(1, 0.4, 0.6, 0.2);
  viscoelastic.law = {"viscoelastic", {{"A", 0.1}}};
  Model plastic = mixed(1, 0.4, 0.6, 0.2);
  plastic.law = {"plastic", {{"speed", 0.5}}};
  Model heated = mixed(0.8, 0.5, 0.5, 0.2);
  heated.effects["thermostat"] = {{"rate", 0.1}};
  for (const Case& one : {Case{mixed(0.8, 0.5, 0.5, 0.2), 0.4, 88, 3, 11},
                          {mixed(0.9, 0.7, 0.3, 5), 0.6, 8, 3, 40},
                          {mixed(0.8, 0.5, 0.5, 0.2), 0.3, 60, 2, 11},
                          {tc, 0.8, 60, 3, 11},
                          {viscoelastic, 0.3, 88, 3, 6},
                          {plastic, 0.3, 60, 2, 11},
                          {heated, 0.3, 88, 3, 6}}) {
    const State start = start_of(one.model, one.n, one.particles, 7, one.d);
    for (const SearchBackend prediction : {SearchBackend::simd, SearchBackend::scalar})
      agrees(one.model, start, one.tau, prediction, smooth_mixture(one.model, start));
  }
}

TEST_CASE("mixtures of rough particles equal the reference") {
  for (const int d : {2, 3}) {
    Model model = mixed(0.8, 0.5, 0.5, 0.2);
    model.effects["roughness"] = {{"beta", 0.3}, {"q", 0.4}};
    model.effects["thermostat"] = {{"rate", 0.1}};
    const State start = start_of(model, 0.3, 60, 7, d);
    agrees(model, start, 8, SearchBackend::simd, RoughMixture(model, TwoSpecies(model, start)));
  }
}

TEST_CASE(
    "mixture: a collision of rough particles conserves momenta and loses the counted energy") {
  Model model = mixed(0.7, 0.5, 0.5, 0.2);
  for (const double beta : {-1.0, -0.4, 0.6, 1.0}) {
    CAPTURE(beta);
    model.effects["roughness"] = {{"beta", beta}, {"q", 0.3}};
    State start = start_of(model, 0.01, 2);
    start.memory["spin"] = {0.2, -1.1, 0.4, 0.9, 0.3, -0.6};
    RoughMixture physics(model, TwoSpecies(model, start));
    physics.recall(start);
    Particle a{{0, 0, 0}, 0, {0.3, -0.2, 0.5}, 0, 0};
    Particle b{{0.45, 0, 0.6}, 0, {-0.7, 0.1, -0.4}, 1, 0};  // at sigma_12 = 0.75
    struct Sum {
      Vector momentum, angular;
      double energy;
    };
    // Angular momentum: orbital, and I omega = (q/2) m sigma w of spin.
    const auto sum = [&] {
      State state = start;
      state.memory.erase("spin");
      physics.store(state);
      const auto& spin = state.memory.at("spin");
      Sum all{};
      for (const Particle& p : {a, b}) {
        const double mass = p.id == 0 ? 1 : 0.2, diameter = p.id == 0 ? 1 : 0.5;
        const Vector w{spin[3 * p.id], spin[3 * p.id + 1], spin[3 * p.id + 2]};
        const Vector orbital = cross(p.position, p.velocity);
        for (std::size_t k = 0; k < 3; ++k) {
          all.momentum[k] += mass * p.velocity[k];
          all.angular[k] += mass * (orbital[k] + 0.3 / 2 * diameter * w[k]);
        }
        all.energy += 0.5 * mass * (dot(p.velocity, p.velocity) + 0.3 * dot(w, w));
      }
      return all;
    };
    const Sum before = sum();
    Clock clock;
    physics.collide(a, b, 0, Box(100), clock);
    const Sum after = sum();
    constexpr double rounding = 1e-14;  // sums of a few numbers of order one
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(std::abs(after.momentum[k] - before.momentum[k]) < rounding);
      CHECK(std::abs(after.angular[k] - before.angular[k]) < rounding);
    }
    CHECK(std::abs(before.energy - after.energy - clock.tally.dissipated) < rounding);
  }
}

TEST_CASE("mixture: the strength of a law of one material depends on the pair") {
  // Two particles of species 2, half as large and of a fifth of the mass: R is half and mu a fifth
  // of that of two particles of species 1. At speed 1 the viscoelastic x = C_1 A (sqrt(R)/mu)^(2/5)
  // = C_1 A 12.5^(1/5), and the yield speed is sqrt(R^3/mu) = sqrt(0.625) of that of species 1.
  const auto loss = [](std::string_view law, Parameters parameters, std::uint32_t id) {
    Model model = mixed(1, 0.5, 0.5, 0.2);
    model.law = {std::string(law), std::move(parameters)};
    const State start = start_of(model, 0.01, 4);
    SmoothMixture physics = smooth_mixture(model, start);
    physics.scale(0);
    const double contact = id < 2 ? 1 : 0.5;
    Particle a{{0, 0, 0}, 0, {0.5, 0, 0}, id, 0};
    Particle b{{contact, 0, 0}, 0, {-0.5, 0, 0}, id + 1, 0};
    Clock clock;
    physics.collide(a, b, 0, Box(100), clock);
    return b.velocity[0] - a.velocity[0];  // e, as the speed of approach was 1
  };
  const auto viscoelastic = [](double x) { return 1 - x + 0.6 * x * x; };
  const double x = 1.15344 * 0.1;
  CHECK(loss("viscoelastic", {{"A", 0.1}}, 0) == doctest::Approx(viscoelastic(x)).epsilon(1e-14));
  CHECK(loss("viscoelastic", {{"A", 0.1}}, 2) ==
        doctest::Approx(viscoelastic(x * std::pow(12.5, 0.2))).epsilon(1e-14));
  CHECK(loss("plastic", {{"speed", 0.1}}, 0) ==
        doctest::Approx(std::pow(0.1, 0.25)).epsilon(1e-14));
  CHECK(loss("plastic", {{"speed", 0.1}}, 2) ==
        doctest::Approx(std::pow(0.1 * std::sqrt(0.625), 0.25)).epsilon(1e-14));
}

TEST_CASE("mixture: SIMD and scalar search give the same bits") {
  for (const int d : {2, 3}) {
    const Model model = mixed(0.8, 0.6, 0.4, 0.1);
    const State start = start_of(model, 0.5, 2000, 5, d);
    Simulation simd(model, start), scalar(model, start, SearchBackend::scalar);
    simd.run_to(collisions_at(20, 2000));
    scalar.run_to(collisions_at(20, 2000));
    CHECK(simd.velocities() == scalar.velocities());
    CHECK(simd.time() == scalar.time());
  }
}

TEST_CASE("mixture: a thermostat shakes both species alike and adds no momentum") {
  // In a time t the mean squared velocity of either species grows by d xi_0^2 t, where rate = d <m>
  // xi_0^2 / 2. It is known to sqrt(2 / 30 000) = 0.8 % for 10 000 particles of each species; four
  // standard errors are allowed.
  const Model model = mixed(1, 0.5, 1, 0.25);
  const State start = start_of(model, 0.1, 20'000);
  const Mixture mixture = mixture_in(start).value();
  std::vector<Particle> particles(20'000);
  copy_particles(start, particles);
  Clock clock;
  clock.now = 0.01;
  Thermostat({{"rate", 5}}, 1, start).act(particles, clock);
  double gained[2] = {};
  Vector momentum{};
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Particle& p = particles[i];
      const double change = p.velocity[k] - start.velocity[i][k];
      gained[mixture.is_second(p.id) ? 1 : 0] += change * change / 10'000;
      momentum[k] += mixture.mass_of(p.id) * p.velocity[k];
    }
  for (const double each : gained)
    CHECK(each == doctest::Approx(2 * 5 * 0.01 / 0.625).epsilon(0.033));
  CHECK(std::sqrt(dot(momentum, momentum)) < 1e-9);
}

TEST_CASE("mixture: a run continued from its state is the same run") {
  const Model model = mixed(0.7, 0.5, 0.6, 0.3);
  Simulation whole(model, start_of(model, 0.5, 500, 3));
  whole.run_to(collisions_at(20, 500));
  Simulation continued(model, whole.state());
  for (const double tau : {23.0, 60.0}) {
    whole.run_to(collisions_at(tau, 500));
    continued.run_to(collisions_at(tau, 500));
    CHECK(whole.velocities() == continued.velocities());
  }
  CHECK(whole.state() == continued.state());
  CHECK(whole.exponent() > 0);
}

TEST_CASE("mixture: a new run begins at energy 1 and is the same mixture") {
  const Model model = mixed(0.7, 0.5, 0.6, 0.3);
  Simulation gas(model, start_of(model, 0.5, 500, 3));
  gas.run_to(collisions_at(10, 500));
  const State again = restarted(gas.state());
  CHECK(Sums(again).energy == doctest::Approx(500).epsilon(1e-12));
  CHECK(mixture_in(again) == mixture_in(gas.state()));
}

TEST_CASE("mixture: spheres may be as near as their radii allow, but no nearer") {
  const Model model = mixed(1, 0.5, 0.5, 1);
  State state = start_of(model, 0.01, 2);
  state.id = {0, 1};  // particle 1 is small
  state.position = {{1, 2, 2}, {1.76, 2, 2}};
  CHECK_FALSE(unsoundness(state));
  state.position[1][0] = 1.74;
  CHECK(unsoundness(state).value().find("overlap") != std::string::npos);
}

TEST_CASE("mixture: small particles grow to their own size, where no lattice of large ones fits") {
  // At these number densities spheres of diameter 1 would fill more than the box. The volume
  // fractions of these gases are 0.31, 0.07 and, for disks, 0.69.
  const auto check = [](const Model& model, double n, std::uint32_t particles, int d) {
    CAPTURE(n);
    CHECK_FALSE(begins_on_lattice(n, particles, d));
    const State state = start_of(model, n, particles, 1, d);
    CHECK(unsoundness(state).value_or("") == "");
    CHECK(Sums(state).energy == doctest::Approx(particles).epsilon(1e-12));
    Simulation gas(model, state);
    gas.run_to(collisions_at(20, particles));
    CHECK(unsoundness(gas.state()).value_or("") == "");
  };
  check(mixed(0.9, 0.857, 0.4, 0.064), 3, 1008, 3);
  check(mixed(0.9, 0.9, 0.1, 0.001), 1.25, 1000, 3);
  check(mixed(0.9, 0.5, 0.5, 0.25), 1.4, 400, 2);
}

TEST_CASE("mixture: bad parameters and other states are named") {
  const State plain = initial_state(0.4, 108, 1);
  const Model model = mixed(0.8, 0.5, 0.5, 0.2);
  CHECK_THROWS_WITH_AS(Simulation(model, plain),
                       "the state is not of the mixture that the model asks for",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Simulation({.restitution = 0.8}, start_of(model, 0.4, 108)),
                       "the state is of a mixture, and the model asks for none",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(start_of(mixed(1, 0.5, 1.5, 1), 0.4, 108),
                       "the model needs diameter_ratio <= 1: species 1 is the larger",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(start_of(mixed(1, 0.001, 0.5, 1), 0.4, 108),
                       "a mixture with so small a fraction needs more particles than 108",
                       std::invalid_argument);
  State wrong = start_of(model, 0.4, 108);
  wrong.memory["mixture"] = {0, 0.5, 0.2};
  CHECK(unsoundness(wrong).value().find("mixture") != std::string::npos);
}
