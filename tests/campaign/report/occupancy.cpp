// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/report/occupancy.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace haff;
using namespace haff::campaign;

namespace {

// A job that ran on a host from one second of a minute to another.
schema::JobRow job(std::int64_t id, const std::string& host, int from, int to, double cpu_seconds) {
  const auto at = [](int second) {
    return "2003-09-05T12:00:" + std::string(second < 10 ? "0" : "") + std::to_string(second) +
           ".000Z";
  };
  schema::JobRow row;
  row.job_id = id;
  row.host = host;
  row.started = at(from);
  row.finished = at(to);
  row.progress.cpu_seconds = cpu_seconds;
  return row;
}

}  // namespace

TEST_CASE("occupancy: times are read as UTC, and other texts give no number") {
  CHECK(seconds_of("1970-01-02T00:00:01.500Z") == 86401.5);
  CHECK(seconds_of("2003-09-05T12:00:00.000Z") == 1062763200.0);
  CHECK(std::isnan(seconds_of("yesterday")));
  CHECK(std::isnan(seconds_of("")));
}

TEST_CASE("occupancy: jobs that overlap add up, and the last step goes down to zero") {
  // One processor from 0 to 10, and half of another from 5 to 15.
  const auto all = occupancy({job(1, "a", 0, 10, 10), job(2, "a", 5, 15, 5)}, {});
  REQUIRE(all.size() == 1);
  const double start = 1062763200;
  CHECK(all[0].host == "a");
  CHECK(all[0].time == std::vector{start, start + 5, start + 10, start + 15});
  CHECK(all[0].busy == std::vector{1.0, 1.5, 0.5, 0.0});
}

TEST_CASE("occupancy: each host has its own curve") {
  const auto all = occupancy({job(1, "b", 0, 10, 10), job(2, "a", 5, 15, 5)}, {});
  REQUIRE(all.size() == 2);
  CHECK(all[0].host == "a");
  CHECK(all[1].host == "b");
}

TEST_CASE("occupancy: a running job counts to its last sign of life") {
  schema::JobRow row = job(1, "a", 0, 0, 20);
  row.finished.reset();
  schema::RunningJob running;
  running.lease.job_id = 1;
  running.renewed = "2003-09-05T12:00:40.000Z";
  const auto all = occupancy({row}, {running});
  REQUIRE(all.size() == 1);
  CHECK(all[0].busy == std::vector{0.5, 0.0});
}

TEST_CASE("occupancy: a job that was interrupted, or never began, has no end and is left out") {
  schema::JobRow interrupted = job(1, "a", 0, 0, 20);
  interrupted.finished.reset();
  schema::JobRow never = interrupted;
  never.started.reset();
  CHECK(occupancy({interrupted, never}, {}).empty());
}
