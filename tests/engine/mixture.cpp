// Mixtures: conservation laws, the naive reference, restarts, and equal species.
#include "engine/mixture.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "engine/initial.hpp"
#include "engine/laws.hpp"
#include "engine/simulation.hpp"
#include "engine/soundness.hpp"
#include "engine/sphere_mixture.hpp"
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

State start_of(const Model& model, double n, std::uint32_t particles, std::uint64_t seed = 1) {
  return initial_state(n, particles, seed, 3, model.effects);
}

void agrees(const Model& model, const State& start, double tau) {
  CAPTURE(start.particles());
  Simulation gas(model, start);
  tests::ReferenceOf<SphereMixture> reference(SphereMixture(model, start.particles()), model,
                                              start);
  for (std::int64_t c = 1; c <= collisions_at(tau, start.particles()); ++c) {
    gas.run_to(c);
    reference.step();
    CAPTURE(c);
    REQUIRE(gas.time() == reference.time());
    REQUIRE(gas.velocities() == reference.velocities());
    if (gas.synchronized()) REQUIRE(gas.state() == reference.state());
  }
}

// Momentum and kinetic energy of all, in scaled units.
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

TEST_CASE("mixture: a new gas has as many of each, energy 1 and no momentum") {
  const Model model = mixed(1, 0.3, 0.5, 0.1);
  const State state = start_of(model, 0.4, 1000);
  const Mixture mixture = mixture_in(state).value();
  CHECK(mixture == Mixture{.first = 700, .diameter = 0.5, .mass = 0.1});
  CHECK_FALSE(unsoundness(state));
  const Sums sums(state);
  CHECK(sums.energy == doctest::Approx(1000).epsilon(1e-12));
  CHECK(std::sqrt(dot(sums.momentum, sums.momentum)) < 1e-11);
  // One temperature: the energy of 300 particles, within four standard errors sqrt(2/900).
  double of_second = 0;
  int in_lower_half = 0;
  for (std::size_t i = 0; i < 1000; ++i)
    if (mixture.is_second(state.id[i])) {
      of_second += 0.5 * 0.1 * dot(state.velocity[i], state.velocity[i]);
      if (state.position[i][2] < 0.5 * state.box) ++in_lower_half;
    }
  CHECK(std::abs(of_second / 300 - 1) < 4 * std::sqrt(2.0 / 900));
  // Everywhere in the box: 150 of 300, within four standard deviations.
  CHECK(std::abs(in_lower_half - 150) < 4 * std::sqrt(75.0));
}

TEST_CASE("mixture: elastic ones keep energy and momentum, others lose what is counted") {
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

TEST_CASE("mixture: of equal species it is the gas of one") {
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
  agrees(mixed(0.8, 0.5, 0.5, 0.2), start_of(mixed(1, 0.5, 0.5, 0.2), 0.4, 88, 7), 11);
  agrees(mixed(0.9, 0.7, 0.3, 5), start_of(mixed(1, 0.7, 0.3, 5), 0.6, 8, 3), 40);
  Model tc = mixed(0.7, 0.4, 0.6, 0.5);
  tc.law = {"tc", {{"t_c", 0.02}}};
  agrees(tc, start_of(tc, 0.8, 60, 3), 11);
}

TEST_CASE("mixture: a gas continued from its state is the same gas") {
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

TEST_CASE("mixture: spheres may be as near as their radii allow, and no nearer") {
  const Model model = mixed(1, 0.5, 0.5, 1);
  State state = start_of(model, 0.01, 2);
  state.id = {0, 1};  // 1 is the small one
  state.position = {{1, 2, 2}, {1.76, 2, 2}};
  CHECK_FALSE(unsoundness(state));
  state.position[1][0] = 1.74;
  CHECK(unsoundness(state).value().find("overlap") != std::string::npos);
}

TEST_CASE("mixture: what does not fit is named") {
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
