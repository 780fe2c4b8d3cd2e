// SPDX-License-Identifier: GPL-3.0-or-later

// Jobs are claimed, given back, failed and reopened: each change is made by its owner alone.
#include <doctest/doctest.h>

#include <atomic>
#include <thread>

#include "schema/fixture.hpp"
#include "schema/store/store.hpp"
#include "schema/store/working.hpp"

using namespace haff::schema;

TEST_CASE("equilibrations come first, and a cooling job when its equilibration is done") {
  Store store = Store::in_memory();
  store.add(plan({cooling(0.8, 1), cooling(0.8, 2)}));
  const auto one = store.claim(me, "test"), other = store.claim(me, "test");
  REQUIRE(one);
  REQUIRE(other);
  CHECK(one->job.kind == Kind::equilibration);
  CHECK(other->job.kind == Kind::equilibration);
  CHECK_FALSE(store.claim(me, "test"));
  CHECK(store.summary().waiting == 2);
  complete(store, *other);
  CHECK(store.summary().claimable == 1);
  const auto next = store.claim(me, "test");
  REQUIRE(next);
  CHECK(next->job.kind == Kind::cooling);
  CHECK(next->equilibration_id == other->lease.job_id);
}

TEST_CASE("a failed equilibration blocks the jobs that need it, until it is retried") {
  Store store = Store::in_memory();
  store.add(plan({cooling(0.8), cooling(0.9)}));
  for (int i = 0; i < max_attempts; ++i) store.fail(store.claim(me, "test")->lease, "jammed");
  CHECK_FALSE(store.claim(me, "test"));
  CHECK(store.summary().blocked == 2);
  CHECK(store.retry_failed() == 1);
  CHECK(store.summary().blocked == 0);
  CHECK(store.summary().waiting == 2);
  CHECK(store.claim(me, "test")->attempts == 0);
}

TEST_CASE("a job is computed again from its start unless a worker holds it") {
  Store store = Store::in_memory();
  store.add(plan({cooling(0.8)}));
  const auto claim = store.claim(me, "test");
  REQUIRE(claim);
  const std::int64_t id = claim->lease.job_id;
  CHECK_FALSE(store.restart(id));
  complete(store, *claim);
  REQUIRE(store.checkpoint(id));
  CHECK(store.restart(id));
  // The old state stays, unused, until a new one replaces it.
  REQUIRE(store.checkpoint(id));
  CHECK(store.job(id).starts_over);
  const auto again = store.claim(me, "test");
  REQUIRE(again);
  CHECK(again->lease.job_id == id);
  CHECK(again->starts_over);
  store.release(again->lease);
  CHECK(store.job(id).starts_over);
  CHECK(store.job(id).progress.tau == 0);
  complete(store, *store.claim(me, "test"));
  CHECK(store.checkpoint(id));
  CHECK_FALSE(store.job(id).starts_over);
}

TEST_CASE("a job that was computed again without a new state leaves no damaged state behind") {
  Store store = Store::in_memory();
  store.add(plan({cooling(0.8)}));
  equilibrate(store);
  const Claim claim = *store.claim(me, "test");
  complete(store, claim, {}, Results{});
  CHECK(store.restart(claim.lease.job_id));
  const Claim again = *store.claim(me, "test");
  store.finish(again.lease, {.progress = {.tau = again.tau_max}}, Results{}, again.tau_max);
  CHECK_FALSE(store.checkpoint(claim.lease.job_id));
  CHECK_FALSE(store.job(claim.lease.job_id).starts_over);
}

TEST_CASE("the longest job is claimed first") {
  Store store = Store::in_memory();
  auto jobs = plan({cooling(0.7), cooling(0.8), cooling(0.9)});
  jobs[1].expected_cpu_seconds = 10;
  jobs[2].expected_cpu_seconds = 30;
  jobs[3].expected_cpu_seconds = 20;
  store.add(jobs);
  equilibrate(store);
  for (const double e : {0.8, 0.9, 0.7}) CHECK(store.claim(me, "test")->job.e == e);
}

TEST_CASE("a claim gives the state of the job and marks its holder") {
  Store store = Store::in_memory();
  auto jobs = plan({cooling()});
  jobs[1].checkpoint_every = 20;
  store.add(jobs);
  equilibrate(store);
  const auto claim = store.claim(another, "version 2");
  REQUIRE(claim);
  CHECK(identity(claim->job) == identity(cooling()));
  CHECK(claim->tau_max == 90);
  CHECK(claim->checkpoint_every == 20);
  const auto running = store.running();
  REQUIRE(running.size() == 1);
  CHECK(running[0].owner == another);
  CHECK(running[0].lease.token == claim->lease.token);
  CHECK(running[0].tau_max == 90);
  CHECK_FALSE(running[0].renewed.empty());
  const JobRow row = store.job(claim->lease.job_id);
  CHECK(row.code_version == "version 2");
  CHECK(row.host == "here");
  CHECK(row.started);
}

TEST_CASE("many connections never claim a job twice") {
  const TemporaryFolder folder;
  std::vector<Job> jobs;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) jobs.push_back(cooling(0.8, seed));
  Store::create(folder / "a.db").add(plan(jobs));

  std::atomic<int> claims = 0;
  {
    std::vector<std::jthread> workers;
    workers.reserve(4);
    for (int i = 0; i < 4; ++i)
      workers.emplace_back([&] {
        Store store = Store::open(folder / "a.db");
        while (store.summary().jobs[Status::done] < 80)
          if (const auto claim = store.claim(me, "test")) {
            ++claims;
            complete(store, *claim);
          }
      });
  }
  CHECK(claims == 80);
  CHECK(Reader(folder / "a.db").summary().jobs[Status::done] == 80);
}

TEST_CASE("a writer whose lease has passed to another is refused and changes nothing") {
  Working old;
  REQUIRE(old.store.reclaim(old.claim.lease));
  const auto next = old.store.claim(another, "test");
  REQUIRE(next);
  CHECK(next->lease.job_id == old.claim.lease.job_id);

  const Commit late{
      .samples = {sample_at(0)}, .checkpoint = Checkpoint{.tau = 10}, .progress = {.tau = 10}};
  CHECK_THROWS_AS(old.store.commit(old.claim.lease, late), LeaseLost);
  CHECK_THROWS_AS(old.store.progress(old.claim.lease, {.tau = 5}), LeaseLost);
  CHECK_THROWS_AS(old.store.finish(old.claim.lease, late, Results{}, 90), LeaseLost);
  CHECK_THROWS_AS(old.store.fail(old.claim.lease, "late"), LeaseLost);
  CHECK_THROWS_AS(old.store.release(old.claim.lease), LeaseLost);
  CHECK_FALSE(old.store.reclaim(old.claim.lease));

  CHECK(old.row().status == Status::running);
  CHECK(old.row().progress.tau == 0);
  CHECK_FALSE(old.row().error);
  CHECK(old.store.samples(next->lease.job_id).empty());
  CHECK_FALSE(old.store.checkpoint(next->lease.job_id));
  old.store.commit(next->lease, late);
}

TEST_CASE("a lease that was released is lost, although no other worker took the job") {
  Working working;
  working.store.release(working.claim.lease);
  CHECK_THROWS_AS(working.store.commit(working.claim.lease, {}), LeaseLost);
  CHECK_THROWS_AS(working.store.release(working.claim.lease), LeaseLost);
}

TEST_CASE("release and reclaim put a job back to its checkpoint and cost no attempt") {
  for (const bool dead : {false, true}) {
    Working working;
    const Lease lease = working.claim.lease;
    working.store.commit(lease, {.checkpoint = Checkpoint{.tau = 10, .collisions = 5000},
                                 .progress = {.tau = 10, .collisions = 5000, .cpu_seconds = 3}});
    working.store.progress(lease, {.tau = 17, .collisions = 8500, .cpu_seconds = 5});
    CHECK(working.row().progress.tau == 17);
    if (dead)
      CHECK(working.store.reclaim(lease));
    else
      working.store.release(lease);
    CHECK(working.row().status == Status::pending);
    CHECK(working.row().progress.tau == 10);
    CHECK(working.row().progress.collisions == 5000);
    CHECK(working.row().progress.cpu_seconds == 5);  // the time that was spent still counts
    CHECK(working.row().attempts == 0);
    CHECK(working.store.running().empty());
    CHECK(working.store.claim(me, "test")->cpu_seconds == 5);
  }
}

TEST_CASE("a job is retried until its attempts are used up") {
  Working working;
  Claim claim = working.claim;
  for (int attempt = 1; attempt < max_attempts; ++attempt) {
    CHECK(working.store.fail(claim.lease, "overlap") == Status::pending);
    claim = *working.store.claim(me, "test");
    CHECK(claim.attempts == attempt);
  }
  CHECK(working.store.fail(claim.lease, "overlap of 3 and 5") == Status::failed);
  CHECK(working.row().status == Status::failed);
  CHECK(working.row().error == "overlap of 3 and 5");
  CHECK(working.row().finished);
  CHECK_FALSE(working.store.claim(me, "test"));
  CHECK(working.store.retry_failed() == 1);
  CHECK(working.store.retry_failed() == 0);
  claim = *working.store.claim(me, "test");
  CHECK(claim.attempts == 0);
  complete(working.store, claim);
  CHECK_FALSE(working.row().error);
}

TEST_CASE("a new checkpoint gives a job back all its attempts") {
  Working working;
  working.store.fail(working.claim.lease, "killed");
  const Claim claim = *working.store.claim(me, "test");
  working.store.commit(claim.lease, {.checkpoint = Checkpoint{.tau = 10}});
  working.store.fail(claim.lease, "killed");
  CHECK(working.store.claim(me, "test")->attempts == 1);
}
