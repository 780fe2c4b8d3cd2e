// SPDX-License-Identifier: GPL-3.0-or-later

// A million windows on two threads: the gas has the bits of one thread at every synchronization.
#include <doctest/doctest.h>

#include <cstdint>
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

// A window has some 300 collisions, a period between two synchronizations half a million of them.
constexpr std::uint32_t particles = 100'000;
constexpr std::int64_t windows = 250'000;

void agrees(const Model& model, double n, int d = 3) {
  const State start = initial_state(n, particles, 1, d);
  Simulation one(model, start);
  Simulation two(model, start, SearchBackend::simd, {.count = 2});
  std::int64_t synchronizations = 0;
  while (two.windows()->count < windows) {
    const double tau = synchronization_period * static_cast<double>(++synchronizations);
    one.run_to(collisions_at(tau, particles));
    two.run_to(collisions_at(tau, particles));
    CAPTURE(tau);
    REQUIRE(two.synchronized());
    REQUIRE(hash_of(two) == hash_of(one));
  }
  const Windows done = *two.windows();
  MESSAGE(done.count << " windows, " << done.repaired << " of them repaired, " << synchronizations
                     << " synchronizations with equal hashes");
  CHECK(done.repaired > 0);
  CHECK(one.events().collisions == two.events().collisions);
  CHECK(one.events().crossings == two.events().crossings);
  CHECK(one.events().stale == two.events().stale);
}

}  // namespace

// Each of these tests takes some two minutes on an idle machine.
TEST_CASE("threads: a quarter of a million windows of an elastic gas") {
  agrees({.restitution = 1}, 0.4);
}

TEST_CASE("threads: a quarter of a million windows of a gas that cools and clusters") {
  agrees({.restitution = 0.8}, 0.4);
}

TEST_CASE("threads: a quarter of a million windows of a dense gas") {
  agrees({.restitution = 0.95}, 0.8);
}

TEST_CASE("threads: a quarter of a million windows of disks") {
  agrees({.restitution = 0.9}, 0.4, 2);
}
