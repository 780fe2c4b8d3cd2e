// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/state/checkpoint.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "campaign/state/restore.hpp"
#include "engine/initial.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

engine::State a_state() {
  engine::State state = engine::initial_state(0.4, 100, 1);
  state.exponent = -3;
  state.collisions = 123456789012;
  state.time = 0.1;
  state.tally = {.dissipated = 1.5, .virial = -0.0};
  state.invariants = {.closest2 = 1 - 1e-15,
                      .past_events = 3,
                      .unresolved_collisions = 1,
                      .energy_mismatch = 1e-14,
                      .momentum_removed = 1e-17};
  state.memory["last_contact"] = {-0.5, 0.0, -std::numeric_limits<double>::infinity()};
  return state;
}

}  // namespace

TEST_CASE("checkpoint: decode gives back the state that was encoded") {
  CHECK(decode(encode(a_state())) == a_state());
}

TEST_CASE("checkpoint: the sign of zero is kept") {
  CHECK(std::signbit(decode(encode(a_state())).tally.virial));
}

TEST_CASE("checkpoint: bytes begin with the name of the format") {
  CHECK(std::memcmp(encode(a_state()).data(), "HAFFGAS\n", 8) == 0);
}

TEST_CASE("checkpoint: equal states have equal bytes") {
  CHECK(encode(a_state()) == encode(a_state()));
}

TEST_CASE("checkpoint: any changed bit is found") {
  auto bytes = encode(a_state());
  for (std::size_t place = 0; place < bytes.size(); place += 7)
    for (int bit = 0; bit < 8; bit += 3) {
      CAPTURE(place);
      bytes[place] ^= std::byte{1} << bit;
      CHECK_THROWS_AS(decode(bytes), DamagedCheckpoint);
      bytes[place] ^= std::byte{1} << bit;
    }
}

TEST_CASE("checkpoint: any cut is found") {
  const auto bytes = encode(a_state());
  for (std::size_t size = 0; size < bytes.size(); size += 13)
    CHECK_THROWS_AS(decode(std::span(bytes).first(size)), DamagedCheckpoint);
}

TEST_CASE("checkpoint: added bytes are found") {
  auto bytes = encode(a_state());
  bytes.resize(bytes.size() + 8);
  CHECK_THROWS_AS(decode(bytes), DamagedCheckpoint);
}

TEST_CASE("checkpoint: a count whose bytes overflow is found behind a valid checksum") {
  engine::State state = a_state();
  state.memory.clear();
  auto bytes = encode(state);
  // The number of ids, after the fields' count and the fields "d" and "box".
  const std::size_t ids = 8 + 4 + 4 + (1 + 1 + 1 + 8 + 4) + (1 + 3 + 1 + 8 + 8) + (1 + 2 + 1);
  const std::uint64_t wrong = (std::uint64_t{1} << 62) + 100;
  std::memcpy(bytes.data() + ids, &wrong, sizeof wrong);
  bytes.resize(bytes.size() - 8);
  const std::uint64_t sum = checkpoint_checksum(bytes);
  bytes.resize(bytes.size() + 8);
  std::memcpy(bytes.data() + bytes.size() - 8, &sum, sizeof sum);
  CHECK_THROWS_WITH_AS(decode(bytes), doctest::Contains("cut short"), DamagedCheckpoint);
}

TEST_CASE("checkpoint: an overlap behind a valid checksum is refused, with pair and depth") {
  const schema::Job job{.e = 0.8, .n = 0.4, .particles = 100, .seed = 1};
  engine::State state = engine::initial_state(job.n, job.particles, 1);
  state.position[1] = state.position[0];
  state.position[1][2] += 0.75;
  CHECK_THROWS_WITH_AS(restore({.tau = 0, .collisions = 0, .state = encode(state)}, job),
                       doctest::Contains("overlap by 0.25"), DamagedCheckpoint);
}

TEST_CASE("checkpoint: disks stay disks, and are refused by a job of spheres") {
  const schema::Job job{.d = 2, .e = 0.8, .n = 0.4, .particles = 100, .seed = 1};
  const engine::State state = engine::initial_state(job.n, job.particles, 1, 2);
  const schema::Checkpoint stored{.tau = 0, .collisions = 0, .state = encode(state)};
  CHECK(restore(stored, job) == state);
  schema::Job spheres = job;
  spheres.d = 3;
  CHECK_THROWS_WITH_AS(restore(stored, spheres), doctest::Contains("dimension 2"),
                       DamagedCheckpoint);
}

TEST_CASE("checkpoint: a state with more energy than was put in is refused") {
  const schema::Job job{.e = 0.8, .n = 0.4, .particles = 100, .seed = 1};
  engine::State state = engine::initial_state(job.n, job.particles, 1);
  CHECK_NOTHROW(restore({.tau = 0, .collisions = 0, .state = encode(state)}, job));
  for (const double factor : {1.1, 1e150, 1e300}) {
    engine::State hot = state;
    for (auto& v : hot.velocity)
      for (double& component : v) component *= factor;
    CHECK_THROWS_WITH_AS(restore({.tau = 0, .collisions = 0, .state = encode(hot)}, job),
                         doctest::Contains("more than was ever put in"), DamagedCheckpoint);
  }
}

TEST_CASE("checkpoint: more fields than a state can have are refused at once") {
  engine::State state = a_state();
  for (int k = 0; k < 100000; ++k) state.memory["m" + std::to_string(k)] = {1};
  CHECK_THROWS_WITH_AS(decode(encode(state)), doctest::Contains("fields"), DamagedCheckpoint);
}

TEST_CASE("checkpoint: one of a newer program does not count as damaged") {
  auto bytes = encode(a_state());
  bytes[8] = std::byte{200};  // the version
  bytes.resize(bytes.size() - 8);
  const std::uint64_t sum = checkpoint_checksum(bytes);
  bytes.resize(bytes.size() + 8);
  std::memcpy(bytes.data() + bytes.size() - 8, &sum, sizeof sum);
  CHECK_THROWS_AS(decode(bytes), NewerCheckpoint);
}

TEST_CASE("checkpoint: it has the physics version, and no job goes on under another version") {
  const schema::Job job{.e = 0.8, .n = 0.4, .particles = 100, .seed = 1};
  schema::Checkpoint stored{.state = encode(engine::initial_state(job.n, job.particles, 1))};
  CHECK(physics_version_of(stored.state) == engine::physics_version);
  CHECK(!foreign_physics(stored));

  // A checkpoint of another version of the engine: the version is the last field.
  const int other = engine::physics_version + 1;
  const std::size_t end = stored.state.size() - sizeof(std::uint64_t);
  std::memcpy(stored.state.data() + end - sizeof other, &other, sizeof other);
  const std::uint64_t sum = checkpoint_checksum(std::span(stored.state).first(end));
  std::memcpy(stored.state.data() + end, &sum, sizeof sum);
  CHECK(physics_version_of(stored.state) == other);
  CHECK(restore(stored, job).particles() == 100);  // it can still be looked at
  const auto why = foreign_physics(stored);
  REQUIRE(why);
  CHECK(why->find("physics version 2, and this program computes version 1") != std::string::npos);
}
