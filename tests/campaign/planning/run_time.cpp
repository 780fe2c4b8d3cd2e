// SPDX-License-Identifier: GPL-3.0-or-later

// The time that a run is expected to take, with the threads that its last jobs get.
#include "campaign/planning/run_time.hpp"

#include <doctest/doctest.h>

#include "engine/threads.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

schema::Job gas(std::uint32_t particles, std::uint64_t seed = 1) {
  schema::Job job;
  job.e = 0.9;
  job.n = 0.4;
  job.particles = particles;
  job.seed = seed;
  return job;
}

// A cooling gas, and its equilibration, which is also planned.
std::vector<schema::Planned> with_its_start(const schema::Job& job, double start, double cooling) {
  return {{.job = schema::equilibration_of(job), .expected_cpu_seconds = start},
          {.job = job, .expected_cpu_seconds = cooling}};
}

std::vector<schema::Planned> small_jobs(int count, double seconds) {
  std::vector<schema::Planned> jobs;
  for (int seed = 1; seed <= count; ++seed)
    jobs.push_back(
        {.job = gas(1000, static_cast<std::uint64_t>(seed)), .expected_cpu_seconds = seconds});
  return jobs;
}

}  // namespace

TEST_CASE("run time: small jobs fill the processors, one thread each") {
  const RunTime four = expected_run_time(small_jobs(10, 7), 4);
  CHECK(four.seconds == doctest::Approx(21));  // 4, 4 and 2 jobs at a time
  CHECK(four.most_threads == 1);
  CHECK(expected_run_time(small_jobs(10, 7), 1).seconds == doctest::Approx(70));
  CHECK(expected_run_time({}, 4).seconds == 0);
}

// This takes a tenth of a second. If each start of a job searched all waiting jobs, it would take a
// minute.
TEST_CASE("run time: that of a hundred thousand jobs is computed at once" * doctest::timeout(10)) {
  CHECK(expected_run_time(small_jobs(100'000, 7), 4).seconds == doctest::Approx(175'000));
}

TEST_CASE("run time: a cooling gas waits for its equilibration") {
  CHECK(expected_run_time(with_its_start(gas(1000), 3, 5), 4).seconds == doctest::Approx(8));
}

TEST_CASE("run time: the last large job has all processors") {
  const double two = engine::expected_speed_up(2, 500'000, 0.4);
  const double four = engine::expected_speed_up(4, 500'000, 0.4);
  REQUIRE(two > 1);
  REQUIRE(four > two);
  const RunTime alone = expected_run_time(with_its_start(gas(500'000), 10, 30), 4);
  CHECK(alone.seconds == doctest::Approx(40 / four));
  CHECK(alone.most_threads == 4);

  // Beside two longer jobs it has two threads, and all four after their end.
  std::vector<schema::Planned> jobs{{.job = gas(500'000), .expected_cpu_seconds = 100},
                                    {.job = gas(1000), .expected_cpu_seconds = 20}};
  CHECK(expected_run_time(jobs, 4).seconds == doctest::Approx(20 + (100 - 20 * two) / four));
}

TEST_CASE("run time: a single job") {
  CHECK(shortest_time(gas(1000), 12, 8) == 12);
  CHECK(shortest_time(gas(500'000), 12, 2) ==
        doctest::Approx(12 / engine::expected_speed_up(2, 500'000, 0.4)));
}
