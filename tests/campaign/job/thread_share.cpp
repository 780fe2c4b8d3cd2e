// SPDX-License-Identifier: GPL-3.0-or-later

// A job's share of the processors, and rows that do not depend on this share.
#include "campaign/job/thread_share.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <vector>

#include "campaign/job/attempt.hpp"
#include "campaign/job/cooling.hpp"
#include "campaign/job/equilibration.hpp"
#include "campaign/run/process.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

schema::Job job(std::uint32_t particles) {
  schema::Job job;
  job.e = 0.8;
  job.n = 0.4;
  job.particles = particles;
  job.seed = 1;
  job.observables = {"laguerre", "temperature"};
  return job;
}

struct Rows {
  std::vector<schema::Sample> samples;
  std::vector<schema::Profile> displacements;
  bool operator==(const Rows&) const = default;
};

// The rows of a cooling gas whose number of threads changes at each of its checkpoints.
Rows rows_with(const std::vector<unsigned>& threads) {
  // Disks in a box with room for four slabs. The job is small: on a busy machine, threads wait for
  // each other for a long time.
  schema::Job cooling = job(500);
  cooling.d = 2;
  cooling.equilibrate = 10;
  cooling.observables = {"laguerre", "msd@5", "temperature"};
  schema::Store store = schema::Store::in_memory();
  store.add({{.job = schema::equilibration_of(cooling), .tau_max = cooling.equilibrate},
             {.job = cooling, .tau_max = 40}});
  const int nowhere = open("/dev/null", O_WRONLY);
  const Reporter reporter(nowhere);
  std::size_t asked = 0;
  while (const auto claim = store.claim(this_process(), "test")) {
    Attempt attempt(store, *claim, reporter, [&] { return threads[asked++ % threads.size()]; });
    const Ending ending =
        claim->job.kind == schema::Kind::equilibration ? equilibrate(attempt) : cool(attempt);
    REQUIRE(ending == Ending::finished);
  }
  close(nowhere);
  if (threads.size() > 1) CHECK(asked == 5);  // at the two beginnings, and at tau = 10, 20 and 30
  const std::int64_t job_id = *store.find(cooling);
  return {store.samples(job_id), store.profiles(job_id, "msd")};
}

}  // namespace

TEST_CASE(
    "thread share: processors are shared out among large jobs, and a small box has room for few "
    "threads") {
  const ThreadShare share{.processors = 8};
  const schema::Job large = job(4'000'000);
  CHECK(threads_for(large, share, 1) == 8);
  CHECK(threads_for(large, share, 3) == 2);
  CHECK(threads_for(large, share, 8) == 1);
  CHECK(threads_for(large, share, 100) == 1);
  CHECK(threads_for(job(500'000), share, 1) == 4);  // slabs of 26 layers of cells
  CHECK(threads_for(job(100'000), share, 1) == 2);
  CHECK(threads_for(job(90'000), share, 1) == 1);
  CHECK(threads_for(job(1000), share, 1) == 1);
}

TEST_CASE("thread share: a job that counts collisions has one thread") {
  schema::Job counting = job(4'000'000);
  counting.observables = {"collision_statistics"};
  CHECK(threads_for(counting, {.processors = 8}, 1) == 1);
}

TEST_CASE("thread share: a number that the user asks for is kept") {
  CHECK(threads_for(job(1000), {.threads = 3, .processors = 8}, 100) == 3);
}

TEST_CASE("thread share: the rows are the same if the number changes at every checkpoint") {
  const Rows one = rows_with({1});
  REQUIRE(one.samples.size() == 41);
  REQUIRE(one.displacements.size() == 1);
  CHECK(one.displacements[0].x.size() == 35);
  CHECK(rows_with({2, 4, 1, 3}) == one);
  CHECK(rows_with({4, 1}) == one);
}
