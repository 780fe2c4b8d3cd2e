// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/report/overview.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "campaign/report/overview_json.hpp"
#include "campaign/run/process.hpp"
#include "schema/fixture.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

// An equilibration and two cooling jobs, each of which is expected to take this many seconds.
schema::Store planned(double expected_cpu_seconds) {
  auto store = schema::Store::in_memory();
  auto jobs = schema::plan({schema::cooling(0.8, 1), schema::cooling(0.9, 1)});
  for (schema::Planned& job : jobs) job.expected_cpu_seconds = expected_cpu_seconds;
  store.add(jobs);
  return store;
}

}  // namespace

TEST_CASE("overview: while nothing runs, the remaining time is not known, and `run` comes next") {
  const schema::Store store = planned(10);
  const Overview overview = look(store);
  CHECK_FALSE(seconds_left(overview));
  CHECK(fraction_done(overview.summary) == 0);
  REQUIRE(next_commands(overview).size() == 1);
  CHECK(next_commands(overview)[0].starts_with("campaign run"));
  CHECK(overview_json(overview)["seconds_left"].is_null());
}

TEST_CASE("overview: the remaining time is that of all jobs left, shared among the running ones") {
  schema::Store store = planned(10);
  REQUIRE(store.claim(this_process(), "test"));
  // One job runs, and three are left.
  const auto left = seconds_left(look(store));
  REQUIRE(left);
  CHECK(*left == doctest::Approx(30));
}

TEST_CASE("overview: a failed equilibration blocks the jobs that start from it") {
  schema::Store store = planned(10);
  const auto claim = store.claim(this_process(), "test");
  REQUIRE(claim);
  store.fail(claim->lease, "for a test", false);
  const Overview overview = look(store);
  const nlohmann::ordered_json object = overview_json(overview);
  CHECK(object["failures"].size() == 1);
  CHECK(object["blocked"].size() == 2);
  REQUIRE(next_commands(overview).size() == 2);
  CHECK(next_commands(overview)[0].starts_with("campaign retry"));
}
