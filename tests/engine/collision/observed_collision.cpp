// SPDX-License-Identifier: GPL-3.0-or-later

// Collisions are counted without a change of the trajectory, and the counts agree with what is
// known of an elastic gas.
#include "engine/collision/observed_collision.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "engine/initial.hpp"
#include "engine/simulation.hpp"

using namespace haff::engine;

namespace {

struct Scene {
  const char* name;
  Model model;
  int d = 3;
  double n = 0.3;
  std::uint32_t particles = 500;
};

std::vector<Scene> scenes() {
  const Parameters roughness{{"beta", 0.5}, {"q", 0.4}};
  const Parameters mixture{{"fraction", 0.5}, {"diameter_ratio", 0.8}, {"mass_ratio", 0.1}};
  return {
      {"smooth", {.restitution = 0.8}},
      {"tc", {.restitution = 0.8, .law = {"tc", {{"t_c", 1e-3}}}}},
      {"rough", {.restitution = 0.8, .effects = {{"roughness", roughness}}}},
      {"mixture", {.restitution = 0.8, .effects = {{"mixture", mixture}}}},
      {"rough mixture",
       {.restitution = 0.8, .effects = {{"mixture", mixture}, {"roughness", roughness}}}},
      {"shuffle", {.restitution = 0.8, .effects = {{"shuffle", {{"every", 1}}}}}},
      {"thermostat", {.restitution = 0.8, .effects = {{"thermostat", {{"rate", 0.05}}}}}},
      {"disks", {.restitution = 0.8}, 2},
      {"small box", {.restitution = 0.8}, 3, 0.3, 20},
      {"small square", {.restitution = 0.8}, 2, 0.3, 10},
      {"large", {.restitution = 0.8}, 3, 0.3, 20000},
  };
}

State start_of(const Scene& scene) {
  return initial_state(scene.n, scene.particles, 7, scene.d, scene.model.effects);
}

Simulation observed(const Scene& scene, const State& start,
                    SearchBackend backend = SearchBackend::simd, unsigned threads = 1) {
  Model model = scene.model;
  model.counts_collisions = true;
  return Simulation(model, start, backend, {.count = threads});
}

template <class Bins>
std::int64_t sum(const Bins& bins) {
  return std::accumulate(bins.begin(), bins.end(), std::int64_t{0});
}

// The sum of (counted - expected)^2 / expected over the number of bins.
double reduced_chi2(const std::vector<double>& counted, const std::vector<double>& expected) {
  double total = 0;
  for (std::size_t i = 0; i < counted.size(); ++i)
    total += std::pow(counted[i] - expected[i], 2) / expected[i];
  return total / static_cast<double>(counted.size());
}

}  // namespace

TEST_CASE("observed_collision: the trajectory has the same bits as without counting") {
  for (const Scene& scene : scenes()) {
    CAPTURE(scene.name);
    const State start = start_of(scene);
    const double tau = scene.particles > 1000 ? 10 : 30;
    const std::int64_t end = collisions_at(tau, scene.particles);
    Simulation plain(scene.model, start), counted = observed(scene, start);
    plain.run_to(end);
    counted.run_to(end);
    State seen = counted.state();
    CHECK(seen.memory.erase("collision_counts") == 1);
    CHECK(seen.memory.erase("last_collision") == 1);
    CHECK(seen == plain.state());
    CHECK_FALSE(plain.take_collision_counts());
  }
}

TEST_CASE(
    "observed_collision: every collision is counted once, and every flight but the first ones") {
  const Scene scene{"smooth", {.restitution = 0.9}};
  Simulation gas = observed(scene, start_of(scene));
  gas.run_to(collisions_at(20, scene.particles));
  const auto counts = *gas.take_collision_counts();
  CHECK(sum(counts.impact) == 5000);
  CHECK(sum(counts.normal_speed) == 5000);
  CHECK(sum(counts.free_time) == 2 * 5000 - 500);
  CHECK(*gas.take_collision_counts() == CollisionCounts{});
}

TEST_CASE(
    "observed_collision: a checkpoint carries the counts, which any search and threads give") {
  for (const Scene& scene : scenes()) {
    CAPTURE(scene.name);
    if (scene.particles > 1000) continue;
    const State start = start_of(scene);
    Simulation whole = observed(scene, start),
               scalar = observed(scene, start, SearchBackend::scalar),
               several = observed(scene, start, SearchBackend::simd, 4);
    whole.run_to(collisions_at(10, scene.particles));
    Simulation resumed = observed(scene, whole.state());
    for (Simulation* gas : {&whole, &resumed, &scalar, &several})
      gas->run_to(collisions_at(33.5, scene.particles));
    const auto counts = *whole.take_collision_counts();
    CHECK(*resumed.take_collision_counts() == counts);
    CHECK(*scalar.take_collision_counts() == counts);
    CHECK(*several.take_collision_counts() == counts);
    // Counts that were taken are not returned again.
    for (Simulation* gas : {&whole, &resumed}) gas->run_to(collisions_at(40, scene.particles));
    CHECK(whole.state() == resumed.state());
  }
}

TEST_CASE("observed_collision: the memory of another gas is refused") {
  const Scene scene{"smooth", {.restitution = 0.9}};
  State state = start_of(scene);
  state.memory["last_collision"] = {1, 2, 3};
  state.memory["collision_counts"] = std::vector<double>(182);
  CHECK_THROWS_AS(observed(scene, state), std::invalid_argument);
  state.memory["last_collision"].assign(500, -1);
  state.memory["collision_counts"] = {1};
  CHECK_THROWS_AS(observed(scene, state), std::invalid_argument);
  // The state has no collisions.
  state.memory["collision_counts"] = std::vector<double>(182);
  CHECK_NOTHROW(observed(scene, state));
  for (const double impossible : {-2.0, 1.0, 1e300}) {
    state.memory["last_collision"][3] = impossible;
    CHECK_THROWS_AS(observed(scene, state), std::invalid_argument);
  }
  state.memory["last_collision"][3] = -1;
  for (const double impossible : {-1.0, 1.0, 1e300}) {
    state.memory["collision_counts"][7] = impossible;
    CHECK_THROWS_AS(observed(scene, state), std::invalid_argument);
  }
}

TEST_CASE("observed_collision: in an elastic gas of any density, molecular chaos is exact") {
  // 10^5 collisions: b^(d-1) is uniform, and normal speeds have the density w exp(-w^2/2), up to
  // terms of order 1/N. Chi^2 over k bins is known to sqrt(2/k); five times that is allowed, a
  // false alarm in one of 10^5 seeds.
  for (const Scene& scene : {Scene{"dilute", {}, 3, 0.02, 2000}, Scene{"dense", {}, 3, 0.5, 2000},
                             Scene{"disks", {}, 2, 0.3, 2000}}) {
    CAPTURE(scene.name);
    Simulation gas = observed(scene, start_of(scene));
    gas.run_to(collisions_at(20, scene.particles));
    gas.take_collision_counts();
    gas.run_to(collisions_at(120, scene.particles));
    const auto counts = *gas.take_collision_counts();
    const auto all = static_cast<double>(sum(counts.impact));
    std::vector<double> counted(counts.impact.begin(), counts.impact.end());
    CHECK(std::abs(reduced_chi2(counted, std::vector<double>(20, all / 20)) - 1) <
          5 * std::sqrt(2.0 / 20));
    counted.clear();
    std::vector<double> expected;
    for (std::size_t bin = 0; bin < 35; ++bin) {  // up to 3.5: 14 collisions in the last bin
      const double low = static_cast<double>(bin) / 10, high = low + 0.1;
      counted.push_back(static_cast<double>(counts.normal_speed[bin]));
      expected.push_back(all * (std::exp(-low * low / 2) - std::exp(-high * high / 2)));
    }
    CHECK(std::abs(reduced_chi2(counted, expected) - 1) < 5 * std::sqrt(2.0 / 35));
  }
}

TEST_CASE("observed_collision: speeds are scaled by the temperature of the moment") {
  // A cooling gas at low density stays close to Maxwell's distribution. Scaled by the temperature
  // of the last synchronization, speeds would be too low by half of the loss in 10 collisions per
  // particle, more than a factor of 2. The mean of w is sqrt(pi/2), within a per cent of noise.
  for (const double mass_ratio : {1.0, 0.5}) {
    Scene scene{"cooling", {.restitution = 0.8}, 3, 0.02, 2000};
    scene.model.effects["mixture"] = {
        {"fraction", 0.5}, {"diameter_ratio", 1}, {"mass_ratio", mass_ratio}};
    Simulation gas = observed(scene, start_of(scene));
    gas.run_to(collisions_at(35, scene.particles));
    const auto counts = *gas.take_collision_counts();
    double mean = 0;
    for (std::size_t bin = 0; bin < counts.normal_speed.size(); ++bin)
      mean += (static_cast<double>(bin) + 0.5) / 10 * static_cast<double>(counts.normal_speed[bin]);
    CHECK(mean / static_cast<double>(sum(counts.normal_speed)) ==
          doctest::Approx(std::sqrt(std::acos(-1.0) / 2)).epsilon(0.03));
  }
}
