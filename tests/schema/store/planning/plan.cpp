// SPDX-License-Identifier: GPL-3.0-or-later

// The changes that a plan makes to a store, and what it leaves as it is.
#include <doctest/doctest.h>

#include <stdexcept>

#include "schema/fixture.hpp"
#include "schema/store/store.hpp"
#include "schema/store/working.hpp"

using namespace haff::schema;

TEST_CASE("a planned job is in the store with all its physics") {
  Store store = Store::in_memory();
  Job job = cooling();
  job.sample_every = 0.5;
  job.seed = 9007199254740991;
  CHECK(store.add(plan({job})) == std::vector{Outcome::added, Outcome::added});
  const auto rows = store.jobs();
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].job.kind == Kind::equilibration);
  CHECK_FALSE(rows[0].equilibration_id);
  CHECK(identity(rows[1].job) == identity(job));
  CHECK(rows[1].equilibration_id == rows[0].job_id);
  CHECK(rows[1].tau_max == 90);
  CHECK(rows[1].checkpoint_every == 10);
  CHECK(rows[1].status == Status::pending);
  CHECK(rows[1].created.size() == std::string("2003-09-05T12:00:00.000Z").size());
  CHECK_FALSE(rows[1].started);
  CHECK(store.find(job) == rows[1].job_id);
  CHECK_FALSE(store.find(cooling(0.5)));
}

TEST_CASE("a second plan adds nothing, and a larger one adds the difference") {
  Store store = Store::in_memory();
  store.add(plan({cooling(0.8)}));
  CHECK(store.add(plan({cooling(0.8)})) == std::vector{Outcome::unchanged, Outcome::unchanged});
  const auto larger = plan({cooling(0.8), cooling(0.9)});
  CHECK(store.preview(larger) ==
        std::vector{Outcome::unchanged, Outcome::unchanged, Outcome::added});
  CHECK(store.jobs().size() == 2);
  CHECK(store.add(larger) == std::vector{Outcome::unchanged, Outcome::unchanged, Outcome::added});
  CHECK(store.jobs().size() == 3);
}

TEST_CASE("tau_max grows and never shrinks") {
  Store store = Store::in_memory();
  store.add(plan({cooling()}, 90));
  CHECK(store.preview(plan({cooling()}, 120))[1] == Outcome::extended);
  CHECK(store.add(plan({cooling()}, 120))[1] == Outcome::extended);
  CHECK(store.add(plan({cooling()}, 60))[1] == Outcome::unchanged);
  CHECK(store.jobs()[1].tau_max == 120);
}

TEST_CASE("a larger tau_max reopens a finished job at its checkpoint") {
  Working working;
  working.store.commit(working.claim.lease,
                       {.checkpoint = Checkpoint{.tau = 80, .collisions = 40000}});
  CHECK(working.store.finish(working.claim.lease, {.progress = {.tau = 90}}, Results{}, 90) ==
        Status::done);
  CHECK(working.row().finished);
  working.store.add(plan({cooling()}, 120));
  CHECK(working.row().status == Status::pending);
  CHECK_FALSE(working.row().finished);
  CHECK(working.store.checkpoint(working.claim.lease.job_id)->tau == 80);
  CHECK(working.store.claim(me, "test")->tau_max == 120);
}

TEST_CASE("a job that is extended while it runs becomes pending at its old length") {
  Working working;
  working.store.add(plan({cooling()}, 120));
  CHECK(working.row().status == Status::running);
  CHECK(complete(working.store, working.claim) == Status::pending);
  CHECK(complete(working.store, *working.store.claim(me, "test")) == Status::done);
}

TEST_CASE("a plan that fails adds nothing") {
  Store store = Store::in_memory();
  auto without_start = plan({cooling(0.8, 1), cooling(0.8, 2)});
  without_start.erase(without_start.begin() + 2);
  CHECK_THROWS_AS(store.add(without_start), std::logic_error);
  CHECK(store.jobs().empty());
}

TEST_CASE("a target that is planned again changes its error, not its pilot runs") {
  Store store = Store::in_memory();
  Target target{.series = series_identity(cooling()),
                .quantity = "a2",
                .tau_from = 5,
                .tau_to = 15,
                .se = 1e-3,
                .pilots = {1, 2, 3, 4, 5}};
  store.add(std::vector{target});
  target.se = 5e-4;
  target.pilots = {6, 7, 8, 9, 10};
  store.add(std::vector{target});
  const auto targets = store.targets();
  REQUIRE(targets.size() == 1);
  CHECK(targets[0].series == target.series);
  CHECK(targets[0].se == 5e-4);
  CHECK(targets[0].pilots == std::vector<std::uint64_t>{1, 2, 3, 4, 5});
}

TEST_CASE("the first prediction for a target is kept, for each standard error") {
  Store store = Store::in_memory();
  Target target{
      .series = series_identity(cooling()), .quantity = "a2", .se = 1e-3, .pilots = {1, 2, 3}};
  store.add(std::vector{target});
  CHECK_FALSE(store.targets()[0].prediction);
  store.predict(target, {.realizations = 20, .cpu_seconds = 3.5});
  store.predict(target, {.realizations = 30, .cpu_seconds = 4.5});
  REQUIRE(store.targets()[0].prediction);
  CHECK(store.targets()[0].prediction->realizations == 20);
  CHECK(store.targets()[0].prediction->cpu_seconds == 3.5);
  target.se = 5e-4;
  store.add(std::vector{target});
  CHECK_FALSE(store.targets()[0].prediction);
}

TEST_CASE("a prediction stands beside its outcome") {
  Store store = Store::in_memory();
  auto jobs = plan({cooling(0.8, 1), cooling(0.8, 2), cooling(0.9, 1)});
  store.add(jobs);
  const Target target{
      .series = series_identity(cooling(0.8)), .quantity = "a2", .se = 1e-3, .pilots = {1, 2}};
  store.add(std::vector{target});
  store.predict(target, {.realizations = 2, .cpu_seconds = 9});
  while (const auto claim = store.claim(me, "test"))
    store.finish(claim->lease,
                 {.checkpoint = Checkpoint{.tau = claim->tau_max},
                  .progress = {.tau = claim->tau_max, .cpu_seconds = 2}},
                 claim->job.kind == Kind::cooling ? std::optional(Results{}) : std::nullopt,
                 claim->tau_max);
  auto rows = store.query(
      "SELECT predicted_realizations, realizations, predicted_cpu_seconds, cpu_seconds "
      "FROM target_outcomes");
  const auto row = rows.next();
  REQUIRE(row);
  CHECK(*row == Row{std::int64_t{2}, std::int64_t{2}, 9.0, 8.0});
}

TEST_CASE("the series of a job is its identity with the seed 0, in SQL as in code") {
  Store store = Store::in_memory();
  Job disks = cooling(0.85, 7);
  disks.d = 2;
  disks.effects = R"({"shuffle":{"every":0.1}})";
  disks.profiles_every = 1e-3;
  store.add(plan({cooling(0.1, 12345678901), disks}));
  for (const JobRow& row : store.jobs()) CHECK(row.series == series_identity(row.job));
}
