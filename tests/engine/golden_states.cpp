// SPDX-License-Identifier: GPL-3.0-or-later

// The bits of twenty-odd trajectories, one of each kind: every effect, both dimensions, dilute and
// dense gases, corners. They are the same with every compiler, SIMD target and machine.
//
// A different hash means that results are not those of the last release. Where that is intended,
// raise physics_version (engine/simulation.hpp) and copy the hashes that this test prints, so that
// a stored job says with which version it was computed.
#include <doctest/doctest.h>
#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "engine/initial.hpp"
#include "engine/simulation.hpp"

using namespace haff::engine;

namespace {

static_assert(physics_version == 1, "the hashes below are those of physics version 1");

// FNV-1a over words: it depends on their order and on every bit.
class Hash {
 public:
  void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3u; }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const std::vector<Vector>& vectors) {
    for (const Vector& each : vectors)
      for (const double component : each) add(component);
  }
  std::string text() const {
    std::array<char, 17> hex{};
    std::snprintf(hex.data(), hex.size(), "%016llx", static_cast<unsigned long long>(value_));
    return hex.data();
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

// Covers positions, velocities and order of all particles, and the time.
std::string hash_of(Simulation& gas) {
  Hash hash;
  for (const std::uint32_t id : gas.ids()) hash.add(std::uint64_t{id});
  hash.add(gas.positions());
  hash.add(gas.velocities());
  hash.add(gas.rotational_energy().value_or(0));
  hash.add(static_cast<std::uint64_t>(gas.exponent()));
  hash.add(static_cast<std::uint64_t>(gas.collisions()));
  hash.add(gas.time());
  const Tally tally = gas.take_tally();
  hash.add(tally.dissipated);
  hash.add(tally.virial);
  return hash.text();
}

struct Scene {
  std::string name;
  std::string hash;
  double n;
  Model model;
  int d = 3;
  std::uint32_t particles = 500;
  double melting = 10;  // elastic collisions per particle before
  double tau = 25;      // beyond two synchronizations, and between two
};

const std::map<std::string, Parameters> mixture{
    {"mixture", {{"fraction", 0.5}, {"diameter_ratio", 0.7}, {"mass_ratio", 0.3}}}};
const std::map<std::string, Parameters> rough{{"roughness", {{"beta", 0.5}, {"q", 0.4}}}};

const std::vector<Scene> scenes{
    {.name = "elastic",
     .hash = "ea3b6013a39c27e5",
     .n = 0.4,
     .model = {.restitution = 1, .seed = 1}},
    {.name = "inelastic",
     .hash = "209f53468cd84778",
     .n = 0.4,
     .model = {.restitution = 0.8, .seed = 1}},
    {.name = "nearly elastic, thin",
     .hash = "54c5536c7564e310",
     .n = 0.001,
     .model = {.restitution = 0.99, .seed = 2}},
    {.name = "dilute",
     .hash = "ae68c3215506849e",
     .n = 0.05,
     .model = {.restitution = 0.85, .seed = 3}},
    {.name = "dense",
     .hash = "236dd04ef3f000a2",
     .n = 0.9,
     .model = {.restitution = 0.9, .seed = 4}},
    {.name = "a crystal that does not melt",
     .hash = "7a154c65b2a0e3df",
     .n = 1.2,
     .model = {.restitution = 0.95, .seed = 5},
     .melting = 0},
    {.name = "very inelastic",
     .hash = "3fdce5cd10b9911e",
     .n = 0.1,
     .model = {.restitution = 0.5, .seed = 6}},
    {.name = "more particles than a lattice holds, grown into place",
     .hash = "b830dae74b59dcce",
     .n = 0.7,
     .model = {.restitution = 0.8, .seed = 7},
     .particles = 333},
    {.name = "thirty-two particles see themselves around the box",
     .hash = "879ca565a1fcdb37",
     .n = 0.38,
     .model = {.restitution = 0.9, .seed = 8},
     .particles = 32},
    {.name = "four particles",
     .hash = "c0b327d4de6abca5",
     .n = 0.2,
     .model = {.restitution = 0.9, .seed = 9},
     .particles = 4,
     .melting = 0},
    {.name = "so many that events are fetched ahead",
     .hash = "efd461fcfcdc8ce6",
     .n = 0.4,
     .model = {.restitution = 0.8, .seed = 10},
     .particles = 20000,
     .melting = 0,
     .tau = 2},
    {.name = "disks",
     .hash = "1ac5592700968a4f",
     .n = 0.4,
     .model = {.restitution = 0.8, .seed = 11},
     .d = 2},
    {.name = "dense disks",
     .hash = "abbe97ab53844efe",
     .n = 0.9,
     .model = {.restitution = 0.95, .seed = 12},
     .d = 2},
    {.name = "threshold",
     .hash = "ef7ba4ca77266702",
     .n = 0.4,
     .model = {.restitution = 0.5, .law = {"threshold", {{"speed", 0.1}}}, .seed = 13}},
    {.name = "threshold, where a constant e would collapse",
     .hash = "4b844d7d81572c89",
     .n = 0.4,
     .model = {.restitution = 0.1, .law = {"threshold", {{"speed", 0.001}}}, .seed = 14}},
    {.name = "TC model",
     .hash = "14028c7842dc8f3e",
     .n = 0.4,
     .model = {.restitution = 0.6, .law = {"tc", {{"t_c", 0.001}}}, .seed = 15}},
    {.name = "viscoelastic",
     .hash = "1919d1bab798370f",
     .n = 0.4,
     .model = {.law = {"viscoelastic", {{"A", 0.1}}}, .seed = 16}},
    {.name = "plastic",
     .hash = "53705660d7bca75d",
     .n = 0.4,
     .model = {.law = {"plastic", {{"speed", 0.1}}}, .seed = 17}},
    {.name = "plastic disks",
     .hash = "c2b2b8e44523892c",
     .n = 0.4,
     .model = {.law = {"plastic", {{"speed", 0.1}}}, .seed = 18},
     .d = 2},
    {.name = "shuffled",
     .hash = "c5f993a83bacb7b2",
     .n = 0.4,
     .model = {.restitution = 0.8, .effects = {{"shuffle", {{"every", 0.7}}}}, .seed = 19}},
    {.name = "heated",
     .hash = "1973dde59836df24",
     .n = 0.4,
     .model = {.restitution = 0.8, .effects = {{"thermostat", {{"rate", 0.5}}}}, .seed = 20}},
    {.name = "rough spheres",
     .hash = "8fb3d965cfd89cef",
     .n = 0.4,
     .model = {.restitution = 0.8, .effects = rough, .seed = 21}},
    {.name = "rough disks",
     .hash = "4d18e45740b76865",
     .n = 0.4,
     .model = {.restitution = 0.9, .effects = rough, .seed = 22},
     .d = 2},
    {.name = "mixture",
     .hash = "e5bdbfa44fc922b2",
     .n = 0.4,
     .model = {.restitution = 0.8, .effects = mixture, .seed = 23}},
    {.name = "mixture of disks",
     .hash = "695fab21ae31aa7e",
     .n = 0.4,
     .model = {.restitution = 0.9, .effects = mixture, .seed = 24},
     .d = 2},
    {.name = "everything at once: rough, heated, of two species, elastic when slow",
     .hash = "94829ae04d70bda4",
     .n = 0.3,
     .model = {.restitution = 0.7,
               .law = {"threshold", {{"speed", 0.05}}},
               .effects = {{"mixture", mixture.at("mixture")},
                           {"roughness", rough.at("roughness")},
                           {"thermostat", {{"rate", 0.2}}}},
               .seed = 25}},
};

Simulation gas_of(const Scene& scene, SearchBackend backend) {
  State start =
      initial_state(scene.n, scene.particles, scene.model.seed, scene.d, scene.model.effects);
  if (scene.melting > 0) {
    Model elastic{.restitution = 1};
    if (const auto found = scene.model.effects.find("mixture"); found != scene.model.effects.end())
      elastic.effects.insert(*found);
    Simulation melting(elastic, start, backend);
    melting.run_to(collisions_at(scene.melting, scene.particles));
    start = restarted(melting.state());
  }
  return {scene.model, start, backend};
}

}  // namespace

// With each SIMD target that is compiled and that this processor has, and without SIMD.
TEST_CASE("the bits of every kind of trajectory are those of this physics version") {
  const auto check = [](SearchBackend backend, const std::string& target) {
    CAPTURE(target);
    for (const Scene& scene : scenes) {
      CAPTURE(scene.name);
      Simulation gas = gas_of(scene, backend);
      gas.run_to(collisions_at(scene.tau, scene.particles));
      CHECK(hash_of(gas) == scene.hash);
    }
  };
  check(SearchBackend::scalar, "none");
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    check(SearchBackend::simd, hwy::TargetName(target));
    CHECK(simd_target() == hwy::TargetName(target));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

// The limits in loop/watchdog.hpp decide when a collapse is noticed.
TEST_CASE("a collapse is noticed after the same collision") {
  Simulation gas({.restitution = 0.1}, initial_state(0.4, 500, 1));
  try {
    gas.run_to(collisions_at(100, 500));
    FAIL("no collapse");
  } catch (const Collapse& collapse) {
    CHECK(collapse.collisions == 750);
  }
}
