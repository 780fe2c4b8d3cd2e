// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/at_time.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "campaign/job/gas.hpp"
#include "campaign/job/measurement.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

std::vector<std::string> names(const std::vector<schema::Profile>& points) {
  std::vector<std::string> all;
  for (const schema::Profile& point : points) all.push_back(point.name);
  return all;
}

}  // namespace

TEST_CASE("at a time: the values after the last collision before it, at the given time") {
  const schema::Job cooling = job(0.8);
  engine::Simulation stopped = gas(cooling), counted = gas(cooling);
  REQUIRE(stopped.run_to(10'000, 2.5));
  counted.run_to(stopped.collisions());
  const auto points = measure_at_time(stopped, cooling, 2.5);
  const schema::Sample there = measure_moment(counted, cooling, 0);
  CHECK(names(points) == std::vector<std::string>{"tau_at_time", "temperature_at_time",
                                                  "a2_at_time", "a3_at_time", "a4_at_time",
                                                  "a5_at_time", "a6_at_time"});
  for (const schema::Profile& point : points) {
    CHECK(point.tau == 0);
    CHECK(point.x == std::vector{2.5});
  }
  CHECK(points[0].value[0] == 2.0 * static_cast<double>(stopped.collisions()) / 1000);
  CHECK(points[1].value[0] == there.temperature.value());
  CHECK(points[2].value[0] == there.a2.value());
  CHECK(counted.time() < 2.5);
}

TEST_CASE("at a time: the tally is not taken, and only observables of the job are measured") {
  schema::Job cooling = job(0.8);
  engine::Simulation looked_at = gas(cooling), left_alone = gas(cooling);
  for (double time = 0.5; looked_at.run_to(1000, time); time += 0.5)
    measure_at_time(looked_at, cooling, time);
  left_alone.run_to(1000);
  CHECK(measure(looked_at, cooling, 2, {}) == measure(left_alone, cooling, 2, {}));
  CHECK(looked_at.take_tally() == left_alone.take_tally());

  cooling.observables = {"temperature"};
  cooling.effects = R"({"roughness":{"beta":0.5,"q":0.4}})";
  engine::Simulation rough = gas(cooling);
  CHECK(names(measure_at_time(rough, cooling, 0)) ==
        std::vector<std::string>{"tau_at_time", "temperature_at_time",
                                 "rotational_temperature_at_time"});
}
