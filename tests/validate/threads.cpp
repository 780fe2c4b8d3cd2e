// SPDX-License-Identifier: GPL-3.0-or-later

// A million windows on two threads: the gas has the bits of one thread at every synchronization.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "engine/initial.hpp"
#include "engine/simulation.hpp"

using namespace haff::engine;

namespace {

// FNV-1a over the bits of a state: positions, velocities, ids, time and sums.
class Hash {
 public:
  Hash& add(const void* data, std::size_t bytes) {
    const auto* byte = static_cast<const unsigned char*>(data);
    for (std::size_t k = 0; k < bytes; ++k) value_ = (value_ ^ byte[k]) * 0x100000001b3u;
    return *this;
  }
  template <class T>
  Hash& add(const std::vector<T>& values) {
    return add(values.data(), values.size() * sizeof(T));
  }
  template <class T>
  Hash& add(const T& value) {
    return add(&value, sizeof value);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

std::uint64_t hash_of(const Simulation& gas) {
  const State state = gas.state();
  return Hash()
      .add(state.id)
      .add(state.position)
      .add(state.velocity)
      .add(state.exponent)
      .add(state.collisions)
      .add(state.time)
      .add(state.tally.dissipated)
      .add(state.tally.virial)
      .value();
}

struct Scene {
  std::string name;
  Model model;
  double n;
  int d;
};

}  // namespace

// A window has some 300 collisions, a period between two synchronizations half a million of them.
// Some minutes on an idle machine.
TEST_CASE("a million windows of 100 000 particles on two threads") {
  constexpr std::uint32_t particles = 100'000;
  constexpr std::int64_t windows_of_scene = 250'000;
  const std::vector<Scene> scenes{
      {"elastic", {.restitution = 1}, 0.4, 3},
      {"cooling and clustering", {.restitution = 0.8}, 0.4, 3},
      {"dense", {.restitution = 0.95}, 0.8, 3},
      {"disks", {.restitution = 0.9}, 0.4, 2},
  };
  for (const Scene& scene : scenes) {
    CAPTURE(scene.name);
    const State start = initial_state(scene.n, particles, 1, scene.d);
    Simulation one(scene.model, start);
    Simulation two(scene.model, start, SearchBackend::simd, {.count = 2});
    std::int64_t synchronizations = 0;
    while (two.windows()->count < windows_of_scene) {
      const auto stop = collisions_at(
          synchronization_period * static_cast<double>(++synchronizations), particles);
      one.run_to(stop);
      two.run_to(stop);
      REQUIRE(two.synchronized());
      CAPTURE(synchronizations);
      REQUIRE(hash_of(two) == hash_of(one));
    }
    const Windows done = *two.windows();
    MESSAGE(scene.name << ": " << done.count << " windows, " << done.repaired
                       << " of them repaired, " << synchronizations
                       << " synchronizations with equal hashes");
    CHECK(done.repaired > 0);
    CHECK(one.events().collisions == two.events().collisions);
    CHECK(one.events().crossings == two.events().crossings);
    CHECK(one.events().stale == two.events().stale);
  }
}
