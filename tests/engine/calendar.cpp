// The calendar: events come out in the order of their times, whatever happened to them since.
#include "engine/calendar.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "engine/random.hpp"

using namespace haff::engine;

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
const auto by_number = [](std::uint32_t particle) { return particle; };

void set(Calendar& calendar, std::uint32_t particle, double time) {
  calendar[particle].time = time;
  calendar.schedule(particle);
}

}  // namespace

TEST_CASE("random events come out in order while others are put in") {
  constexpr std::uint32_t particles = 1000;
  // Near, far beyond the last window, and with gaps of whole windows between.
  for (const double reach : {1e-3, 1.0, 1e4}) {
    CAPTURE(reach);
    Random random(7, Stream::velocities);
    Calendar calendar(particles);
    calendar.restart(particles);
    std::vector<double> times(particles);
    for (std::uint32_t p = 0; p < particles; ++p)
      set(calendar, p, times[p] = reach * random.uniform());
    for (int step = 0; step < 20'000; ++step) {
      const std::uint32_t first = calendar.next(by_number);
      const auto expected = std::min_element(times.begin(), times.end());
      REQUIRE(first == expected - times.begin());
      const double now = *expected;
      set(calendar, first, times[first] = now + reach * random.uniform());
      // Another is given a new time, earlier or later, and its old entry is void.
      const auto other = static_cast<std::uint32_t>(random.uniform() * particles);
      set(calendar, other, times[other] = now + 0.1 * reach * random.uniform());
    }
  }
}

TEST_CASE("events of the same time come out by rank") {
  Calendar calendar(8);
  calendar.restart(8);
  for (const std::uint32_t p : {5u, 2u, 7u, 0u}) set(calendar, p, 0.5);
  for (const std::uint32_t p : {1u, 3u, 4u, 6u}) set(calendar, p, never);
  for (const std::uint32_t p : {0u, 2u, 5u, 7u}) {
    CHECK(calendar.next(by_number) == p);
    set(calendar, p, never);
  }
  CHECK(calendar.next(by_number) == Calendar::nobody);
}

TEST_CASE("an event set again to the time it had comes out once") {
  Calendar calendar(2);
  calendar.restart(2);
  set(calendar, 0, 0.25);
  set(calendar, 0, 0.25);
  set(calendar, 1, 0.5);
  CHECK(calendar.next(by_number) == 0);
  set(calendar, 0, never);
  CHECK(calendar.next(by_number) == 1);
}

TEST_CASE("a forgotten entry does not come out, and at the end there is nothing to forget") {
  Calendar calendar(3);
  calendar.restart(3);
  for (const std::uint32_t p : {0u, 1u, 2u}) set(calendar, p, 0.5 + 0.01 * p);
  CHECK(calendar.next(by_number) == 0);
  set(calendar, 0, never);
  calendar.forget(1);
  set(calendar, 1, never);
  CHECK(calendar.next(by_number) == 2);
  set(calendar, 2, never);
  for (const std::uint32_t p : {0u, 1u, 2u}) calendar.forget(p);
  CHECK(calendar.next(by_number) == Calendar::nobody);
}
