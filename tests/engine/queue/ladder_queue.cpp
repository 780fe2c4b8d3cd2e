// SPDX-License-Identifier: GPL-3.0-or-later

// The ladder queue: events come out in the order of their times, even if their times were changed.
#include "engine/queue/ladder_queue.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "engine/support/random.hpp"

using namespace haff::engine;

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
const auto by_number = [](std::uint32_t particle) { return particle; };

void set(LadderQueue& queue, std::uint32_t particle, double time) {
  queue[particle].time = time;
  queue.schedule(particle);
}

}  // namespace

TEST_CASE("random events come out in order while others are put in") {
  constexpr std::uint32_t particles = 1000;
  // Times are near, far beyond the last window, or have gaps of whole windows between them.
  for (const double reach : {1e-3, 1.0, 1e4}) {
    CAPTURE(reach);
    Random random(7, Stream::velocities);
    LadderQueue queue(particles);
    queue.restart(particles);
    std::vector<double> times(particles);
    for (std::uint32_t p = 0; p < particles; ++p)
      set(queue, p, times[p] = reach * random.uniform());
    for (int step = 0; step < 20'000; ++step) {
      const std::uint32_t first = queue.next(by_number);
      const auto expected = std::min_element(times.begin(), times.end());
      REQUIRE(first == expected - times.begin());
      const double now = *expected;
      set(queue, first, times[first] = now + reach * random.uniform());
      // Another particle is given a new time, earlier or later, and its old entry is outdated.
      const auto other = static_cast<std::uint32_t>(random.uniform() * particles);
      set(queue, other, times[other] = now + 0.1 * reach * random.uniform());
    }
  }
}

TEST_CASE("events of the same time come out by rank") {
  LadderQueue queue(8);
  queue.restart(8);
  for (const std::uint32_t p : {5u, 2u, 7u, 0u}) set(queue, p, 0.5);
  for (const std::uint32_t p : {1u, 3u, 4u, 6u}) set(queue, p, never);
  for (const std::uint32_t p : {0u, 2u, 5u, 7u}) {
    CHECK(queue.next(by_number) == p);
    set(queue, p, never);
  }
  CHECK(queue.next(by_number) == LadderQueue::nothing);
}

TEST_CASE("an event that is set again to its old time comes out once") {
  LadderQueue queue(2);
  queue.restart(2);
  set(queue, 0, 0.25);
  set(queue, 0, 0.25);
  set(queue, 1, 0.5);
  CHECK(queue.next(by_number) == 0);
  set(queue, 0, never);
  CHECK(queue.next(by_number) == 1);
}

TEST_CASE("a forgotten entry does not come out, and at the end there is nothing to forget") {
  LadderQueue queue(3);
  queue.restart(3);
  for (const std::uint32_t p : {0u, 1u, 2u}) set(queue, p, 0.5 + 0.01 * p);
  CHECK(queue.next(by_number) == 0);
  set(queue, 0, never);
  queue.forget(1);
  set(queue, 1, never);
  CHECK(queue.next(by_number) == 2);
  set(queue, 2, never);
  for (const std::uint32_t p : {0u, 1u, 2u}) queue.forget(p);
  CHECK(queue.next(by_number) == LadderQueue::nothing);
}

TEST_CASE("an event beyond all windows comes once, however often its particle was scheduled") {
  LadderQueue queue(3);
  queue.restart(3, 2);
  set(queue, 0, 1);
  for (const double time : {1e6, 1.1e6, 1.2e6}) set(queue, 1, time);
  set(queue, 2, 1.3e6);
  CHECK(queue.next(by_number) == 0);
  set(queue, 0, never);
  CHECK(queue.look_ahead() == 1);
  CHECK(queue.look_ahead() == 2);  // not 1 again
  CHECK(queue.next(by_number) == 1);
}

TEST_CASE("the queue looks ahead at every event that is to come, once for a contact") {
  constexpr std::uint32_t particles = 60;
  constexpr std::uint32_t entries_ahead = 8;
  LadderQueue queue(particles);
  queue.restart(particles, entries_ahead);
  for (std::uint32_t p = 0; p < particles; ++p) {
    queue[p].face = Event::contact;
    queue[p].partner = p ^ 1;
    set(queue, p, 0.5 + 0.01 * (p / 2));
  }
  set(queue, 4, 9);  // their entries are outdated
  set(queue, 5, 9);
  std::vector<std::uint32_t> seen;
  for (std::uint32_t pair = 0; pair < particles / 2; ++pair) {
    if (pair == 2) continue;
    const std::uint32_t p = queue.next(by_number);
    REQUIRE(p / 2 == pair);
    do {
      const std::uint32_t coming = queue.look_ahead();
      if (coming == LadderQueue::nothing) break;
      seen.push_back(coming / 2);
    } while (!queue.looks_far());
    queue.forget(p ^ 1);
    set(queue, p, never);
    set(queue, p ^ 1, never);
  }
  // Also the first one: it had come, but not its partner's entry.
  std::vector<std::uint32_t> all;
  for (std::uint32_t pair = 0; pair < particles / 2; ++pair)
    if (pair != 2) all.push_back(pair);
  all.push_back(2);
  CHECK(seen == all);
}
