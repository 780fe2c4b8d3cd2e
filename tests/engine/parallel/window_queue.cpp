// SPDX-License-Identifier: GPL-3.0-or-later

// The events of one window come in the order of their times, whether they were taken at its
// beginning or added on the way, and outdated entries are dropped.
#include "engine/parallel/window_queue.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace haff::engine;

namespace {

std::uint32_t by_number(std::uint32_t particle) {
  return particle;
}

std::uint32_t next(WindowQueue& queue) {
  return queue.next(by_number);
}

}  // namespace

TEST_CASE("window queue: the first event first, and of equal times the smallest rank") {
  std::vector<Event> events(6);
  const double times[] = {3, 1, 2, 1, 5, 2};
  for (std::size_t p = 0; p < events.size(); ++p) events[p].time = times[p];
  WindowQueue queue(events.data());
  for (const std::uint32_t p : {0u, 3u, 1u, 2u}) queue.take(p);
  queue.sort();
  queue.add(4);
  queue.add(5);
  for (const std::uint32_t expected : {1u, 3u, 2u, 5u, 0u, 4u}) CHECK(next(queue) == expected);
  CHECK(next(queue) == WindowQueue::nothing);
}

TEST_CASE("window queue: an event with a new time comes at that time, and only then") {
  std::vector<Event> events(3);
  for (std::size_t p = 0; p < events.size(); ++p) events[p].time = 1 + static_cast<double>(p);
  WindowQueue queue(events.data());
  queue.merge({{1, 0}, {3, 2}});
  queue.merge({{2, 1}});
  events[1].time = 4;
  queue.add(1);
  CHECK(next(queue) == 0);
  std::vector<std::uint32_t> waiting;
  queue.for_each([&](std::uint32_t p) { waiting.push_back(p); });
  CHECK(waiting == std::vector<std::uint32_t>{2, 1});
  CHECK(next(queue) == 2);
  CHECK(next(queue) == 1);
  CHECK(next(queue) == WindowQueue::nothing);
}

TEST_CASE("window queue: it looks ahead at every event that is to come, once for a contact") {
  constexpr std::uint32_t particles = 40;
  std::vector<Event> events(particles);
  WindowQueue queue(events.data());
  for (std::uint32_t p = 0; p < particles; ++p) {
    events[p].time = 1 + p / 2;  // two particles each, like the partners of a contact
    queue.take(p);
  }
  queue.sort();
  CHECK(queue.first_taken() < 2);
  events[4].time = events[5].time = 100;  // their entries are outdated
  std::vector<std::uint32_t> seen;
  for (int step = 0; step < 19; ++step) {
    do {
      const std::uint32_t p = queue.look_ahead();
      if (p == WindowQueue::nothing) break;
      CHECK(events[p].time >= 1 + step);  // not after it has come
      seen.push_back(p / 2);
    } while (!queue.looks_far());
    for (int partner = 0; partner < 2; ++partner) {
      const std::uint32_t p = next(queue);
      REQUIRE(p != WindowQueue::nothing);
      events[p].time = 1000;
    }
  }
  std::vector<std::uint32_t> all;
  for (std::uint32_t pair = 0; pair < particles / 2; ++pair)
    if (pair != 2) all.push_back(pair);
  CHECK(seen == all);
}
