// SPDX-License-Identifier: GPL-3.0-or-later

// Slabs have equal shares of the work, within one layer of cells, and a gas has as many threads as
// are useful.
#include "engine/parallel/slabs.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "engine/threads.hpp"

using namespace haff::engine;

namespace {

Cell at_height(std::uint32_t layer) {
  Cell cell{0};
  cell.set(2, layer);
  return cell;
}

}  // namespace

TEST_CASE("slabs: a border may cut a layer of bricks in two") {
  const Bricks bricks(Box(31), 20'000);
  REQUIRE(bricks.cells() == 30);
  Slabs slabs;
  slabs.divide(bricks, std::vector<std::uint32_t>(30, 7), 2);
  for (std::uint32_t layer = 0; layer < 30; ++layer)
    CHECK(slabs.slab_of(at_height(layer)) == (layer < 15 ? 0 : 1));
  // Two layers at each border belong to zones only.
  const Slab& upper = slabs.slab(1);
  for (const std::uint32_t layer : {14u, 15u, 16u, 28u, 29u, 0u})
    CHECK_FALSE(upper.workable().hold(at_height(layer)));
  for (const std::uint32_t layer : {17u, 27u}) CHECK(upper.workable().hold(at_height(layer)));
  // Layers 14 and 15 are one brick, which has no owner.
  CHECK_FALSE(upper.holds_brick_of(at_height(15)));
  CHECK(upper.holds_brick_of(at_height(16)));
  CHECK_FALSE(upper.holds_brick_next_to(at_height(16)));
  CHECK(upper.holds_brick_next_to(at_height(17)));
  // Across the end of the box.
  CHECK(slabs.slab(0).holds_brick_next_to(at_height(29)));
}

TEST_CASE("slabs: work that is not spread evenly") {
  const Bricks bricks(Box(41), 40'000);
  REQUIRE(bricks.cells() == 40);
  std::vector<std::uint32_t> work(40, 10);
  for (std::uint32_t layer = 0; layer < 10; ++layer) work[layer] = 30;
  Slabs slabs;
  slabs.divide(bricks, work, 2);
  CHECK(slabs.slab_of(at_height(9)) == 0);
  CHECK(slabs.slab_of(at_height(10)) == 1);
}

TEST_CASE("slabs: useful threads") {
  CHECK(useful_threads(1'000, 0.4) == 1);
  CHECK(useful_threads(99'999, 0.4) == 1);
  CHECK(useful_threads(100'000, 0.4) == 2);
  CHECK(useful_threads(1'000'000, 0.4) == 5);
  CHECK(useful_threads(10'000'000, 0.4) == 12);
  CHECK(useful_threads(100'000, 0.4, 2) == 2);
  CHECK(useful_threads(64, 0.4) == 1);
}

TEST_CASE(
    "slabs: more threads are expected to be faster, up to the useful number and never by more") {
  CHECK(expected_speed_up(1, 500'000, 0.4) == 1);
  for (const std::uint32_t particles : {100'000u, 1'000'000u, 10'000'000u}) {
    double before = 1;
    for (unsigned threads = 2; threads <= useful_threads(particles, 0.4); ++threads) {
      const double expected = expected_speed_up(threads, particles, 0.4);
      CHECK(expected > before);
      CHECK(expected < threads);
      before = expected;
    }
  }
}

TEST_CASE("slabs: two threads are expected to be as fast as measured") {
  // decisions/several-cores.md; its ratios repeat to 5 %.
  constexpr double repeats_to = 0.05;
  CHECK(expected_speed_up(2, 100'000, 0.4) == doctest::Approx(1.56).epsilon(repeats_to));
  CHECK(expected_speed_up(2, 500'000, 0.4) == doctest::Approx(1.58).epsilon(repeats_to));
  CHECK(expected_speed_up(2, 1'000'000, 0.4) == doctest::Approx(1.57).epsilon(repeats_to));
}
