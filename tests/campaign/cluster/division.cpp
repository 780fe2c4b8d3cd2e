// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/cluster/division.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

using namespace haff;
using namespace haff::campaign;
using schema::JobRow;
using schema::Kind;
using schema::Status;

namespace {

JobRow equilibration(std::int64_t id, double cpu_seconds, Status status = Status::pending) {
  JobRow row;
  row.job_id = id;
  row.job.kind = Kind::equilibration;
  row.job.particles = 1000;
  row.job.n = 0.4;
  row.tau_max = 50;
  row.status = status;
  row.expected_cpu_seconds = cpu_seconds;
  return row;
}

JobRow cooling(std::int64_t id, std::int64_t start, double cpu_seconds,
               Status status = Status::pending) {
  JobRow row = equilibration(id, cpu_seconds, status);
  row.job.kind = Kind::cooling;
  row.equilibration_id = start;
  return row;
}

}  // namespace

TEST_CASE("division: every pending job is in one share, after its equilibration") {
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    std::vector<JobRow> rows;
    const int starts = 1 + static_cast<int>(random() % 6);
    for (int i = 0; i < starts; ++i)
      rows.push_back(equilibration(i + 1, 1 + static_cast<double>(random() % 10),
                                   random() % 3 == 0 ? Status::done : Status::pending));
    for (int i = 0; i < 20; ++i)
      rows.push_back(cooling(100 + i,
                             1 + static_cast<int>(random() % static_cast<unsigned>(starts)),
                             1 + static_cast<double>(random() % 30)));
    std::multiset<std::int64_t> cooling_jobs;
    for (const Share& share : divide(rows, 1 + random() % 8)) {
      std::set<std::int64_t> seen;
      for (const std::int64_t id : share.jobs) {
        CHECK(seen.insert(id).second);
        if (id < 100) continue;
        cooling_jobs.insert(id);
        CHECK(seen.contains(
            rows[static_cast<std::size_t>(starts + id - 100)].equilibration_id.value()));
      }
    }
    CHECK(cooling_jobs.size() == 20);
    CHECK(std::set(cooling_jobs.begin(), cooling_jobs.end()).size() == 20);
  }
}

TEST_CASE("division: loads differ by at most the longest job") {
  std::vector<JobRow> rows;
  std::mt19937 random(11);
  for (int i = 0; i < 40; ++i) {
    rows.push_back(equilibration(i + 1, 2));
    rows.push_back(cooling(100 + i, i + 1, 1 + static_cast<double>(random() % 50)));
  }
  const auto shares = divide(rows, 5);
  REQUIRE(shares.size() == 5);
  const auto [least, most] =
      std::ranges::minmax(shares, {}, [](const Share& share) { return share.cpu_seconds; });
  CHECK(most.cpu_seconds - least.cpu_seconds <= 52);
  CHECK(most.longest_cpu_seconds <= 52);
}

TEST_CASE("division: jobs that share an expensive equilibration stay together") {
  std::vector<JobRow> rows{equilibration(1, 100), equilibration(2, 100)};
  for (int i = 0; i < 4; ++i) rows.push_back(cooling(10 + i, 1 + i % 2, 10));
  const auto shares = divide(rows, 2);
  REQUIRE(shares.size() == 2);
  for (const Share& share : shares) {
    CHECK(share.cpu_seconds == 120);
    CHECK(share.longest_cpu_seconds == 110);
    CHECK(share.makespan(1) == 120);
    CHECK(share.makespan(4) == 110);
  }
}

TEST_CASE("division: jobs that run, are lent, or wait for a failed equilibration stay") {
  const std::vector<JobRow> rows{
      equilibration(1, 1, Status::failed), cooling(10, 1, 5), equilibration(2, 1, Status::done),
      cooling(11, 2, 5, Status::running), cooling(12, 2, 5, Status::lent)};
  CHECK(divide(rows, 3).empty());
}

TEST_CASE("division: fewer jobs than shares make fewer shards, and progress counts") {
  JobRow half = cooling(10, 1, 60);
  half.progress.tau = 25;
  const std::vector<JobRow> rows{equilibration(1, 5, Status::done), half};
  const auto shares = divide(rows, 8);
  REQUIRE(shares.size() == 1);
  CHECK(shares[0].jobs == std::vector<std::int64_t>{1, 10});
  CHECK(shares[0].cpu_seconds == 30);
}
