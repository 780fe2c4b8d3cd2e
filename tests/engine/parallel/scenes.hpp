// SPDX-License-Identifier: GPL-3.0-or-later

// Gases of every kind that several threads can divide, and the comparison of their states.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "engine/initial.hpp"
#include "engine/simulation.hpp"

namespace haff::tests {

struct Scene {
  std::string name;
  engine::Model model;
  int d = 3;
  double n = 0.4;
  std::uint32_t particles = 16'000;  // four slabs of four layers
};

inline const engine::Parameters mixed{
    {"fraction", 0.5}, {"diameter_ratio", 0.8}, {"mass_ratio", 0.5}};
inline const engine::Parameters rough{{"beta", 0.5}, {"q", 0.4}};

inline std::vector<Scene> scenes() {
  return {
      {"elastic", {.restitution = 1}},
      {"inelastic", {.restitution = 0.8}},
      {"dense", {.restitution = 0.9}, 3, 0.9, 40'000},
      {"dilute", {.restitution = 0.7}, 3, 0.05},
      {"threshold", {.restitution = 0.6, .law = {"threshold", {{"speed", 0.1}}}}},
      {"tc", {.restitution = 0.6, .law = {"tc", {{"t_c", 1e-3}}}}},
      {"viscoelastic", {.law = {"viscoelastic", {{"A", 0.1}}}}},
      {"plastic", {.law = {"plastic", {{"speed", 0.1}}}}},
      {"shuffle", {.restitution = 0.8, .effects = {{"shuffle", {{"every", 1}}}}, .seed = 3}},
      {"thermostat", {.restitution = 0.8, .effects = {{"thermostat", {{"rate", 0.1}}}}, .seed = 3}},
      {"rough", {.restitution = 0.8, .effects = {{"roughness", rough}}}},
      {"mixture", {.restitution = 0.8, .effects = {{"mixture", mixed}}}},
      {"rough mixture",
       {.restitution = 0.8, .effects = {{"roughness", rough}, {"mixture", mixed}}}},
      {"disks", {.restitution = 0.8}, 2, 0.4, 4000},
      {"rough disks", {.restitution = 0.8, .effects = {{"roughness", rough}}}, 2, 0.4, 4000},
      {"mixed disks", {.restitution = 0.8, .effects = {{"mixture", mixed}}}, 2, 0.4, 4000},
  };
}

// Calls test(scene, start), where start is the scene's initial state for this seed, for all scenes,
// or for the named ones.
template <class Test>
void for_each_scene(std::uint64_t seed, const std::vector<std::string>& names, const Test& test) {
  std::size_t tested = 0;
  for (const Scene& scene : scenes()) {
    if (!names.empty() && std::find(names.begin(), names.end(), scene.name) == names.end())
      continue;
    CAPTURE(scene.name);
    ++tested;
    test(scene,
         engine::initial_state(scene.n, scene.particles, seed, scene.d, scene.model.effects));
  }
  CHECK(tested == (names.empty() ? scenes().size() : names.size()));
}
inline const std::vector<std::string> all_scenes;
// One of each kind of region: spheres, spheres with spins, disks.
inline const std::vector<std::string> undone_scenes{"inelastic", "rough", "disks"};

// Compares all that can be observed of a gas at any time.
inline void check_same(const engine::Simulation& one, const engine::Simulation& several) {
  REQUIRE(several.collisions() == one.collisions());
  CHECK(several.time() == one.time());
  CHECK(several.ids() == one.ids());
  CHECK(several.velocities() == one.velocities());
  CHECK(several.positions() == one.positions());
  CHECK(several.rotational_energy() == one.rotational_energy());
  CHECK(several.invariants() == one.invariants());
  CHECK(several.events().collisions == one.events().collisions);
  CHECK(several.events().crossings == one.events().crossings);
  CHECK(several.events().stale == one.events().stale);
}

}  // namespace haff::tests
