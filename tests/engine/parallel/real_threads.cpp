// SPDX-License-Identifier: GPL-3.0-or-later

// Two, three and four real threads give the bits of one, without data races (ctest --preset tsan).
#include <doctest/doctest.h>

#include "engine/initial.hpp"
#include "engine/parallel/scenes.hpp"
#include "engine/simulation.hpp"

using namespace haff::engine;
using namespace haff::tests;

// The runs are short, since on a busy machine threads wait for each other for a long time. Shuffled
// and heated gases are synchronized on the way.
TEST_CASE("real threads: every effect, spheres and disks, on two to four") {
  for_each_scene(1, all_scenes, [](const Scene& scene, const State& start) {
    const bool acts = scene.name == "shuffle" || scene.name == "thermostat";
    const std::int64_t last = collisions_at(acts ? 1.1 : 0.3, scene.particles);
    Simulation one(scene.model, start);
    one.run_to(last);
    for (const unsigned count : {2u, 3u, 4u}) {
      CAPTURE(count);
      Simulation several(scene.model, start, SearchBackend::simd,
                         {.count = count, .window = 0.001});
      several.run_to(last);
      check_same(one, several);
      CHECK(several.windows()->in_slabs > 0);
    }
  });
}

TEST_CASE("real threads: windows that are undone") {
  for_each_scene(2, undone_scenes, [](const Scene& scene, const State& start) {
    Simulation one(scene.model, start);
    one.run_to(collisions_at(1, scene.particles));
    Simulation several(scene.model, start, SearchBackend::simd, {.count = 3, .window = 0.1});
    several.run_to(collisions_at(1, scene.particles));
    check_same(one, several);
    CHECK(several.windows()->repaired > 0);
  });
}

TEST_CASE("real threads: through a synchronization") {
  constexpr std::uint32_t particles = 16'000;
  const State start = initial_state(0.4, particles, 3);
  const Model model{.restitution = 0.8};
  Simulation one(model, start);
  Simulation several(model, start, SearchBackend::simd, {.count = 2, .window = 0.01});
  for (const double tau : {10.0, 10.2}) {
    one.run_to(collisions_at(tau, particles));
    several.run_to(collisions_at(tau, particles));
    check_same(one, several);
    if (one.synchronized()) CHECK(several.state() == one.state());
  }
  CHECK(several.windows()->in_zones > 0);
}
