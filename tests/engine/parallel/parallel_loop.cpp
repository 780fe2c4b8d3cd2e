// SPDX-License-Identifier: GPL-3.0-or-later

// Several threads compute the same bits as one: every effect, spheres and disks, any number of
// threads, windows of any length, stops anywhere.
#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <vector>

#include "engine/initial.hpp"
#include "engine/parallel/scenes.hpp"
#include "engine/simulation.hpp"
#include "engine/support/random.hpp"

using namespace haff::engine;
using namespace haff::tests;

// These results do not depend on the scheduling of threads, so one thread may process all slabs;
// real_threads.cpp has real threads.
TEST_CASE("slabs: every effect, spheres and disks, in two to four slabs") {
  for_each_scene(1, all_scenes, [](const Scene& scene, const State& start) {
    std::vector<std::unique_ptr<Simulation>> divided;
    Simulation one(scene.model, start);
    // Windows of random length, 5 to 60 collisions, and stops at random collisions. In slabs as
    // thin as these, much longer windows nearly always have to be repaired, which the next case
    // tests.
    Random random(7, Stream::velocities);
    for (const unsigned slabs : {2u, 3u, 4u}) {
      const Threads threads{
          .count = 1, .slabs = slabs, .window = 0.0003 + 0.0035 * random.uniform()};
      divided.push_back(
          std::make_unique<Simulation>(scene.model, start, SearchBackend::simd, threads));
      REQUIRE(divided.back()->windows());
    }
    for (const double tau : {0.3 + random.uniform(), 3 + random.uniform(), 10.0}) {
      one.run_to(collisions_at(tau, scene.particles));
      const Tally expected = one.take_tally();
      for (const auto& several : divided) {
        several->run_to(collisions_at(tau, scene.particles));
        check_same(one, *several);
        const Tally tally = several->take_tally();
        CHECK(tally == expected);
        CHECK(several->windows()->in_slabs > 0);
        CHECK(several->windows()->in_zones > 0);
      }
    }
    REQUIRE(one.synchronized());
    for (const auto& several : divided) CHECK(several->state() == one.state());
  });
}

TEST_CASE("threads: windows that are much too long are undone and repaired") {
  for_each_scene(2, undone_scenes, [](const Scene& scene, const State& start) {
    for (const double window : {0.05, 0.3, 1.0}) {
      CAPTURE(window);
      Simulation one(scene.model, start);
      Simulation several(scene.model, start, SearchBackend::simd,
                         {.count = 1, .slabs = 4, .window = window});
      // A few windows at a time, so that a wrong window would be seen at once.
      for (double tau = 2.5 * window; tau < 4; tau += 2.5 * window) {
        one.run_to(collisions_at(tau, scene.particles));
        several.run_to(collisions_at(tau, scene.particles));
        check_same(one, several);
        CHECK(several.take_tally() == one.take_tally());
      }
      // With thin slabs and so many collisions, nearly every window has an event that came too
      // early.
      CHECK(several.windows()->repaired > several.windows()->count / 2);
    }
  });
}

TEST_CASE("threads: a run may change their number at any stored state") {
  const State start = initial_state(0.4, 16'000, 3);
  const Model model{.restitution = 0.8};
  Simulation one(model, start);
  one.run_to(collisions_at(30, 16'000));
  State state = start;
  for (const unsigned count : {3u, 1u, 4u}) {
    Simulation part(model, state, SearchBackend::simd, {.count = 1, .slabs = count});
    part.run_to(part.collisions() + collisions_at(synchronization_period, 16'000));
    state = part.state();
  }
  CHECK(state == one.state());
}

TEST_CASE("threads: a box too small to be divided runs on one thread") {
  const State start = initial_state(0.4, 500, 1);
  const Simulation gas({.restitution = 0.8}, start, SearchBackend::simd, {.count = 4});
  CHECK_FALSE(gas.windows());
}

TEST_CASE("threads: a collapse is the same as on one thread") {
  // A dense, very inelastic gas collapses within a few collisions per particle.
  const State start = initial_state(0.6, 16'000, 1);
  const Model model{.restitution = 0.05};
  const auto collapse_of = [&](unsigned count) {
    Simulation gas(model, start, SearchBackend::simd, {.count = 1, .slabs = count});
    std::string message = "none";
    try {
      gas.run_to(collisions_at(20, 16'000));
    } catch (const Collapse& collapse) {
      message = collapse.what();
    }
    return std::pair(message, gas.velocities());
  };
  const auto one = collapse_of(1);
  CHECK(one.first != "none");
  CHECK(collapse_of(2) == one);
  CHECK(collapse_of(4) == one);
}
