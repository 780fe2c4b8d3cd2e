// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/timetable.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

using namespace haff;
using namespace haff::campaign;

namespace {

schema::Job job(double sample_every, std::uint32_t particles = 100) {
  schema::Job job;
  job.sample_every = sample_every;
  job.particles = particles;
  return job;
}

std::vector<Stop> all(Timetable timetable) {
  std::vector<Stop> stops;
  while (const auto stop = timetable.next()) stops.push_back(*stop);
  return stops;
}

std::vector<double> taus(const std::vector<Stop>& stops, Stop::Due due, bool kept_only = false) {
  std::vector<double> list;
  for (const Stop& stop : stops)
    if (stop.due == due && (stop.keep || !kept_only)) list.push_back(stop.tau);
  return list;
}

}  // namespace

TEST_CASE("timetable: samples from 0 to tau_max") {
  CHECK(taus(all(Timetable(job(4), 13, 10)), Stop::Due::sample) ==
        std::vector<double>{0, 4, 8, 12});
}

TEST_CASE("timetable: a last sample that rounding puts above tau_max is taken") {
  CHECK(sample_count(0.1, 0.3) == 4);  // 3 * 0.1 > 0.3
  CHECK(sample_count(0.1, 90) == 901);
  CHECK(sample_count(1, 90) == 91);
  CHECK(sample_count(7, 6) == 1);
}

TEST_CASE("timetable: the number of the synchronization at or after a tau") {
  CHECK(synchronization_at_or_after(0) == 0);
  CHECK(synchronization_at_or_after(1) == 1);
  CHECK(synchronization_at_or_after(10) == 1);
  CHECK(synchronization_at_or_after(10.5) == 2);
}

TEST_CASE("timetable: it has every synchronization up to the last sample") {
  CHECK(taus(all(Timetable(job(5), 34, 10)), Stop::Due::synchronization) ==
        std::vector<double>{10, 20, 30});
}

TEST_CASE("timetable: at the same collision, the sample comes first") {
  const auto stops = all(Timetable(job(5), 10, 10));
  REQUIRE(stops.size() == 4);
  CHECK(stops[2].due == Stop::Due::sample);
  CHECK(stops[3].due == Stop::Due::synchronization);
  CHECK(stops[2].collisions == stops[3].collisions);
}

TEST_CASE("timetable: states are kept at or after each multiple of checkpoint_every") {
  const auto kept = [](double checkpoint_every) {
    return taus(all(Timetable(job(1), 100, checkpoint_every)), Stop::Due::synchronization, true);
  };
  CHECK(kept(25) == std::vector<double>{30, 50, 80, 100});
  CHECK(kept(40) == std::vector<double>{40, 80, 100});
  CHECK(kept(3) == std::vector<double>{10, 20, 30, 40, 50, 60, 70, 80, 90, 100});
  CHECK(kept(10) == std::vector<double>{10, 20, 30, 40, 50, 60, 70, 80, 90, 100});
  CHECK(kept(1e6) == std::vector<double>{100});
}

TEST_CASE("timetable: the last synchronization before the end is kept") {
  CHECK(taus(all(Timetable(job(1), 47, 1000)), Stop::Due::synchronization, true) ==
        std::vector<double>{40});
}

TEST_CASE("timetable: a stored state is past all events up to its number of collisions") {
  Timetable timetable(job(5), 30, 10);
  timetable.skip_through(500);  // tau = 10
  const auto stops = all(timetable);
  CHECK(taus(stops, Stop::Due::sample) == std::vector<double>{15, 20, 25, 30});
  CHECK(taus(stops, Stop::Due::synchronization) == std::vector<double>{20, 30});
}

TEST_CASE("timetable: collisions never decrease") {
  const auto stops = all(Timetable(job(0.3, 7), 50, 10));
  for (std::size_t k = 1; k < stops.size(); ++k)
    CHECK(stops[k - 1].collisions <= stops[k].collisions);
}

// ---- moments of their own ---------------------------------------------------------------------

TEST_CASE("timetable: samples of sample_at come between the others") {
  schema::Job between = job(4);
  between.sample_at.tau.listed = {0.5, 8, 9.5, 12.5};
  const auto stops = all(Timetable(between, 13, 10));
  CHECK(taus(stops, Stop::Due::sample) == std::vector<double>{0, 0.5, 4, 8, 9.5, 12, 12.5});
  CHECK(sample_count(between, 13) == 7);
  CHECK(sample_count(between, 12) == 6);
}

TEST_CASE("timetable: a moment that is the collision of another sample is left out") {
  schema::Job ten = job(1, 10);  // tau = 0.2 is one collision
  ten.sample_at.tau.listed = {0.05, 0.1, 0.95, 1.9, 1.95};
  CHECK(taus(all(Timetable(ten, 2, 10)), Stop::Due::sample) == std::vector<double>{0, 0.05, 1, 2});
  schema::Job decades = job(1, 10);
  decades.sample_at.tau = {.per_decade = 20, .from = 0.1};
  const auto stops = all(Timetable(decades, 20, 10));
  for (std::size_t k = 1; k < stops.size(); ++k)
    if (stops[k].due == Stop::Due::sample && stops[k - 1].due == Stop::Due::sample)
      CHECK(stops[k].collisions > stops[k - 1].collisions);
  CHECK(static_cast<std::int64_t>(taus(stops, Stop::Due::sample).size()) ==
        sample_count(decades, 20));
}

TEST_CASE("timetable: rounding does not make a second sample at one moment") {
  schema::Job tenth = job(0.1);
  tenth.sample_at.tau.listed = {0.3};  // 3 * 0.1 > 0.3
  CHECK(taus(all(Timetable(tenth, 0.4, 10)), Stop::Due::sample) ==
        std::vector<double>{0, 0.1, 0.2, 3 * 0.1, 0.4});
}

TEST_CASE("timetable: snapshots come after the sample at their collision, before its state") {
  schema::Job kept = job(5);
  kept.snapshots_at.tau.listed = {0, 10, 12.5};
  const auto stops = all(Timetable(kept, 12.5, 10));
  std::vector<Stop::Due> due;
  for (const Stop& stop : stops) due.push_back(stop.due);
  using enum Stop::Due;
  CHECK(due == std::vector{sample, snapshot, sample, sample, snapshot, synchronization, snapshot});
  Timetable later(kept, 12.5, 10);
  later.skip_through(500);
  CHECK(taus(all(later), snapshot) == std::vector{12.5});
}

TEST_CASE("timetable: the state before the last moment is kept") {
  schema::Job late = job(7);
  late.snapshots_at.tau.listed = {20};
  CHECK(taus(all(Timetable(late, 20, 1000)), Stop::Due::synchronization, true) ==
        std::vector{20.0});
}

TEST_CASE("timetable: profiles and fields are not taken at moments of sample_at") {
  schema::Job profiled = job(1);
  profiled.profiles_every = 10;
  profiled.fields_at = {10};
  CHECK(has_profiles(profiled, 10));
  profiled.sample_at.tau.listed = {9.8};
  CHECK(has_profiles(profiled, 10));
  CHECK(has_fields(profiled, 10));
  CHECK_FALSE(has_profiles(profiled, 9.8));
  CHECK_FALSE(has_fields(profiled, 9.8));
}

TEST_CASE("timetable: moments up to an infinite time are counted, also if there are none") {
  constexpr double never = std::numeric_limits<double>::infinity();
  CHECK(count_through({}, never) == 0);
  CHECK(count_through({.listed = {1, 2}}, never) == 2);
  CHECK(count_through({.per_decade = 10, .from = 0.1}, never) == 3011);
}
