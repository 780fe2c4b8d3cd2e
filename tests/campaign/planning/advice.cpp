// SPDX-License-Identifier: GPL-3.0-or-later

// Advice on a plan: values that differ by rounding, and gases that are computed twice.
#include "campaign/planning/advice.hpp"

#include <doctest/doctest.h>

using namespace haff;
using campaign::near_twins;
using campaign::recomputed;

namespace {

schema::Job cooling(double e) {
  return {.e = e, .n = 0.4, .particles = 500, .seed = 1, .observables = {"temperature"}};
}

schema::JobRow done(const schema::Job& job) {
  schema::JobRow row;
  row.job = job;
  row.status = schema::Status::done;
  row.progress.collisions = 1000;
  return row;
}

}  // namespace

TEST_CASE("advice: a value within 1e-9 of one in the store is pointed out") {
  const std::vector known{done(cooling(0.85))};
  CHECK(near_twins({{.job = cooling(0.85)}}, known).empty());
  CHECK(near_twins({{.job = cooling(0.86)}}, known).empty());
  const auto lines = near_twins({{.job = cooling(0.8500000001)}}, known);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].starts_with("e = 0.8500000001 of this grid and 0.85 of the store"));
  // From below as well.
  CHECK(near_twins({{.job = cooling(0.8499999999)}}, known).size() == 1);
}

TEST_CASE("advice: other observables of a finished gas would compute it a second time") {
  schema::Job more = cooling(0.85);
  more.observables = {"laguerre", "temperature"};
  CHECK(recomputed({{.job = more}}, {done(cooling(0.85))}) == 1);
  CHECK(recomputed({{.job = cooling(0.85)}}, {done(cooling(0.85))}) == 0);
  CHECK(recomputed({{.job = more}}, {done(cooling(0.9))}) == 0);
  CHECK(recomputed({{.job = more}}, {}) == 0);
}
