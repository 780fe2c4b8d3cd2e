// SPDX-License-Identifier: GPL-3.0-or-later

// The properties of each effect, and that a resumed run with effects is the same run.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "engine/actions/actions.hpp"
#include "engine/collision/pair_geometry.hpp"
#include "engine/initial.hpp"
#include "engine/restitution/plastic_impact.hpp"
#include "engine/restitution/viscoelastic.hpp"
#include "engine/simulation.hpp"
#include "support/gas.hpp"

using namespace haff::engine;

namespace {

constexpr std::uint32_t particles = 500;

void goes_on_from_its_state(const Model& model) {
  Simulation whole(model, initial_state(0.4, particles, 3));
  whole.run_to(collisions_at(10, particles));
  Simulation continued(model, whole.state());
  for (const double tau : {13.0, 20.0, 30.0}) {
    whole.run_to(collisions_at(tau, particles));
    continued.run_to(collisions_at(tau, particles));
    REQUIRE(whole.velocities() == continued.velocities());
    REQUIRE(whole.time() == continued.time());
  }
  CHECK(whole.state() == continued.state());
}

// e of a law that decides e itself, in a collision of this normal speed, in units of velocities
// scaled by 2^exponent.
template <class RestitutionModel>
double e_at(double speed, const Parameters& parameters, int exponent = 0) {
  RestitutionModel law(1, parameters);
  law.scale(exponent);
  const Particle particle{};
  const double scaled = std::ldexp(speed, exponent);
  return law({particle, particle, 0, scaled * scaled, 1, 1});
}

}  // namespace

TEST_CASE("effects: a resumed run is the same run") {
  goes_on_from_its_state({.restitution = 0.8, .effects = {{"shuffle", {{"every", 1}}}}, .seed = 3});
  goes_on_from_its_state(
      {.restitution = 0.8, .effects = {{"shuffle", {{"every", 0.7}}}}, .seed = 3});
  goes_on_from_its_state(
      {.restitution = 0.8, .effects = {{"thermostat", {{"rate", 0.5}}}}, .seed = 3});
  goes_on_from_its_state({.restitution = 0.8,
                          .law = {"tc", {{"t_c", 1e-3}}},
                          .effects = {{"shuffle", {{"every", 3}}}, {"thermostat", {{"rate", 2}}}},
                          .seed = 3});
  goes_on_from_its_state({.law = {"viscoelastic", {{"A", 0.3}}}});
}

TEST_CASE("effects: observing a gas changes nothing") {
  const Model model{.restitution = 0.8,
                    .effects = {{"shuffle", {{"every", 3}}}, {"thermostat", {{"rate", 2}}}}};
  const State start = initial_state(0.4, particles, 1);
  Simulation once(model, start);
  Simulation often(model, start);
  once.run_to(collisions_at(20, particles));
  for (std::int64_t collisions = 0; collisions < collisions_at(20, particles); collisions += 37)
    often.run_to(collisions);
  often.run_to(collisions_at(20, particles));
  CHECK(once.state() == often.state());
}

TEST_CASE("effects: an unknown effect or a missing parameter is named") {
  const State start = initial_state(0.4, particles, 1);
  CHECK_THROWS_WITH_AS(Simulation({.effects = {{"shufle", {}}}}, start),
                       "there is no effect shufle", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Simulation({.effects = {{"shuffle", {}}}}, start),
                       "the model needs every > 0", std::invalid_argument);
}

TEST_CASE("shuffle: the same velocities are on other particles") {
  Simulation gas({.restitution = 1, .effects = {{"shuffle", {{"every", 1}}}}, .seed = 1},
                 initial_state(0.4, particles, 1));
  Simulation left_alone({.restitution = 1}, initial_state(0.4, particles, 1));
  gas.run_to(collisions_at(1, particles));
  left_alone.run_to(collisions_at(1, particles));
  auto shuffled = gas.velocities();
  auto plain = left_alone.velocities();
  CHECK(shuffled != plain);
  // Equal when sorted, up to the momentum removed by the synchronization, 1e-16 of a velocity.
  std::sort(shuffled.begin(), shuffled.end());
  std::sort(plain.begin(), plain.end());
  double largest = 0;
  for (std::size_t i = 0; i < plain.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      largest = std::max(largest, std::abs(shuffled[i][k] - plain[i][k]));
  CHECK(largest < 1e-14);
}

TEST_CASE("shuffle: a velocity is equally likely to be on any particle") {
  // The new place of particle 0's velocity among 8, in 8000 permutations: chi^2 with 7 degrees of
  // freedom exceeds 29.9 once in 10^4 seeds.
  Shuffle shuffle({{"every", 1}}, 5, {});
  std::array<double, 8> places{};
  for (std::int64_t k = 1; k <= 8000; ++k) {
    std::vector<Particle> all(8);
    all[0].velocity[0] = 1;
    Clock clock;
    clock.collisions = k;
    shuffle.act(all, clock);
    for (std::size_t p = 0; p < 8; ++p) places[p] += all[p].velocity[0];
  }
  double chi2 = 0;
  for (const double seen : places) chi2 += (seen - 1000) * (seen - 1000) / 1000;
  CHECK(chi2 < 29.9);
}

TEST_CASE("thermostat: an elastic gas gains the energy that it is given, and no momentum") {
  // 400 kicks of 3N deviates: the gain has a standard error of 2 sqrt(v^2 w) summed, below 1 %
  // here; the tolerance of 5 % is five of them.
  constexpr double rate = 0.5;
  Simulation gas({.restitution = 1, .effects = {{"thermostat", {{"rate", rate}}}}, .seed = 2},
                 initial_state(0.4, particles, 1));
  gas.run_to(collisions_at(100, particles));
  const double gained = haff::tests::energy(gas) / particles - 1;
  CHECK(gained == doctest::Approx(rate * gas.time()).epsilon(0.05));
  CHECK(haff::tests::relative_momentum(gas) < 1e-12);
}

TEST_CASE("viscoelastic: e(v) is the series, in any units of speed") {
  // The fifth root is good to some 1e-15.
  for (const double v : {1e-12, 0.01, 0.7, 1.0, 3.0})
    for (const int exponent : {-7, -5, 0, 3, 40}) {
      const double x = 1.15344 * 0.3 * std::pow(v, 0.2);
      CHECK(e_at<Viscoelastic>(v, {{"A", 0.3}}, exponent) ==
            doctest::Approx(1 - x + 0.6 * x * x).epsilon(1e-14));
    }
  // The minimum of the series is 7/12, at x = 5/6.
  CHECK(e_at<Viscoelastic>(1, {{"A", 5.0 / 6 / 1.15344}}) ==
        doctest::Approx(7.0 / 12).epsilon(1e-14));
}

TEST_CASE("viscoelastic: a run ends where the series gives e above 1") {
  CHECK_THROWS_AS((e_at<Viscoelastic>(1, {{"A", 2}})), PhysicsError);
}

// A decade of speed lowers e of metals by a factor of 10^(1/4) = 1.78.
TEST_CASE("plastic: e falls as v^(-1/4) above the yield speed, in any units of speed") {
  for (const int exponent : {-7, 0, 3}) {
    const auto e = [&](double speed) {
      return e_at<PlasticImpact>(speed, {{"speed", 0.25}}, exponent);
    };
    CHECK(e(1e-9) == 1);
    CHECK(e(0.25) == 1);
    CHECK(e(4) == 0.5);
    CHECK(e(0.5) / e(5) == doctest::Approx(1.7782794100389228).epsilon(1e-15));
  }
}

TEST_CASE("fifth root: the bits are the same everywhere") {
  CHECK(fifth_root(32) == 2);
  CHECK(fifth_root(1) == 1);
  CHECK(fifth_root(0.5) == doctest::Approx(0.87055056329612413).epsilon(1e-15));
}
