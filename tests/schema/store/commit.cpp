// SPDX-License-Identifier: GPL-3.0-or-later

// Commits: what is stored, what is refused, and what remains after a crash or a full disk.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

#include "schema/fixture.hpp"
#include "schema/store/store.hpp"
#include "schema/store/working.hpp"

using namespace haff::schema;

TEST_CASE("a commit is read back to the last bit") {
  Working working;
  const Sample first{.tau = 0, .time = 0, .temperature = 2.0 / 3};
  const Sample second{.tau = 1,
                      .time = 0.1 + 0.2,
                      .temperature = 1e-60 / 3,
                      .gamma_ratio = 0.97,
                      .collision_rate = 4.1,
                      .pressure = 1.3,
                      .a2 = -0.01,
                      .a3 = -5e-324,
                      .a4 = 1.7976931348623157e308,
                      .a5 = 1e-17,
                      .a6 = 0.0};
  working.store.commit(working.claim.lease, {.samples = {first, second}});
  CHECK(working.store.samples(working.claim.lease.job_id) == std::vector{first, second});
}

TEST_CASE("the last sample before a checkpoint is found") {
  Working working;
  const auto job_id = working.claim.lease.job_id;
  CHECK_FALSE(working.store.last_sample(job_id, 90));
  working.store.commit(working.claim.lease,
                       {.samples = {sample_at(0), sample_at(1), sample_at(2)}});
  CHECK(working.store.last_sample(job_id, 1.5) == sample_at(1));
  CHECK(working.store.last_sample(job_id, 2) == sample_at(2));
  CHECK(working.store.last_sample(job_id, 90) == sample_at(2));
}

TEST_CASE("a sample that is not finite is refused with all of its commit") {
  Working working;
  const Lease lease = working.claim.lease;
  for (const double broken : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Sample sample = sample_at(1);
    sample.a2 = broken;
    const Commit commit{.samples = {sample_at(0), sample}, .checkpoint = Checkpoint{.tau = 10}};
    CHECK_THROWS_AS(working.store.commit(lease, commit), Damage);
  }
  CHECK(working.store.samples(lease.job_id).empty());
  CHECK_FALSE(working.store.checkpoint(lease.job_id));
}

TEST_CASE("finishing stores the results and ends the lease") {
  Working working;
  const Lease lease = working.claim.lease;
  const Results results{.tau_c = 58.5, .time_c = 100.25};
  CHECK(complete(working.store, working.claim, {sample_at(0)}, results) == Status::done);
  CHECK(working.store.results(lease.job_id) == results);
  CHECK(working.row().status == Status::done);
  CHECK(working.row().finished);
  CHECK(working.row().progress.tau == 90);
  CHECK(working.store.running().empty());
  CHECK_THROWS_AS(working.store.commit(lease, {}), LeaseLost);
}

TEST_CASE("a result that was not reached is NULL, while a missing row is no result") {
  Working working;
  CHECK_FALSE(working.store.results(working.claim.lease.job_id));
  complete(working.store, working.claim, {}, Results{});
  CHECK(working.store.results(working.claim.lease.job_id) == Results{});
}

TEST_CASE("a writer killed at any moment leaves the samples and the checkpoint of one commit") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  Store::create(path).add(plan({cooling()}));
  const auto state = bytes(200'000);
  for (unsigned kill_after = 0; kill_after < 20; ++kill_after) {
    const pid_t child = fork();
    if (child == 0) {
      Store store = Store::open(path);
      const Claim claim = *store.claim(me, "test");
      const auto last = store.checkpoint(claim.lease.job_id);
      for (double tau = last ? last->tau + 1 : 0;; ++tau)
        store.commit(claim.lease, {.samples = {sample_at(tau)},
                                   .checkpoint = Checkpoint{.tau = tau, .state = state}});
    }
    // The later writers are killed some time after a commit, however slow the machine is.
    if (kill_after >= 10) {
      const auto before = Reader(path).last_sample(1, 1e9);
      const auto begin = std::chrono::steady_clock::now();
      const auto has_committed = [&] {
        const auto now = Reader(path).last_sample(1, 1e9);
        return now && (!before || now->tau > before->tau);
      };
      while (!has_committed() &&
             std::chrono::steady_clock::now() - begin < std::chrono::seconds(10))
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5 + 7 * (kill_after % 10)));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);

    Store store = Store::open(path);
    CHECK(store.faults().empty());
    for (const RunningJob& running : store.running()) CHECK(store.reclaim(running.lease));
    const auto checkpoint = store.checkpoint(1);
    const auto sample = store.last_sample(1, 1e9);
    REQUIRE(checkpoint.has_value() == sample.has_value());
    if (checkpoint) {
      CHECK(checkpoint->state == state);
      CHECK(checkpoint->tau == sample->tau);
      CHECK(store.samples(1).size() == static_cast<std::size_t>(sample->tau) + 1);
    }
  }
  CHECK(Reader(path).checkpoint(1));
}

TEST_CASE("a full disk undoes the commit, is reported, and leaves the store sound") {
  const TemporaryFolder folder;
  Working working(Store::create(folder / "a.db"));
  const Lease lease = working.claim.lease;
  const Checkpoint first{.tau = 10, .collisions = 5000, .state = bytes(100'000)};
  working.store.commit(lease, {.samples = {sample_at(0)}, .checkpoint = first});

  // The kernel refuses to let any file of this process grow beyond 1 MB, as a full disk would.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{.rlim_cur = 1'000'000, .rlim_max = before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const Commit large{.samples = {sample_at(1)},
                     .checkpoint = Checkpoint{.tau = 20, .state = bytes(3'000'000)}};
  CHECK_THROWS_AS(working.store.commit(lease, large), DiskError);
  setrlimit(RLIMIT_FSIZE, &before);

  CHECK(working.store.samples(lease.job_id) == std::vector{sample_at(0)});
  CHECK(working.store.checkpoint(lease.job_id)->state == first.state);
  CHECK(Reader(folder / "a.db").faults().empty());
  working.store.commit(lease, large);
  CHECK(working.store.checkpoint(lease.job_id)->tau == 20);
}
