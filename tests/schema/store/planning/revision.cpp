// SPDX-License-Identifier: GPL-3.0-or-later

// Jobs that are cancelled and grids that replace a plan: what is removed, what stays, and that the
// store is sound afterwards.
#include "schema/store/planning/revision.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "schema/fixture.hpp"

using namespace haff::schema;

namespace {

Sample at(double tau) {
  return {.tau = tau, .time = tau, .temperature = 1};
}

// Runs the next job up to tau = 30 of 90, and stores it there.
std::int64_t begin_next(Store& store) {
  const auto claim = store.claim(me, "test").value();
  store.commit(claim.lease, {.samples = {at(0), at(30)},
                             .checkpoint = Checkpoint{.tau = 30, .state = bytes(8)},
                             .progress = {.tau = 30}});
  store.release(claim.lease);
  return claim.lease.job_id;
}

const Dismissal& of_job(const Revision& revision, std::int64_t job_id) {
  return *std::ranges::find_if(revision.jobs,
                               [&](const Dismissal& each) { return each.row.job_id == job_id; });
}

std::int64_t count(const Revision& revision, Fate fate) {
  return std::ranges::count(revision.jobs, fate, &Dismissal::fate);
}

bool is_sound(const Store& store) {
  bool sound = store.faults().empty() && store.wrong_tables().empty();
  for (const std::int64_t id : store.job_ids()) sound = sound && store.digests(id).wrong.empty();
  return sound;
}

Target target_of(const Job& job) {
  return {.series = series_identity(job),
          .quantity = "a2",
          .tau_from = 5,
          .tau_to = 15,
          .se = 1e-3,
          .pilots = {1, 2}};
}

}  // namespace

TEST_CASE("planned jobs are removed, and equilibrations with the last job that starts from them") {
  Revised store(Store::in_memory());
  store.add(plan({cooling(0.8), cooling(0.9)}));  // 1: equilibration, 2, 3
  CHECK(count(store.cancel(Choice(store, "e = 0.8"), false), Fate::removed) == 1);
  CHECK(store.job_ids() == std::vector<std::int64_t>{1, 3});
  CHECK(count(store.cancel(Choice(store, "e = 0.9"), false), Fate::removed) == 2);
  CHECK(store.job_ids().empty());
  CHECK(is_sound(store));
}

TEST_CASE("a preview of a cancellation changes nothing and gives the same result") {
  Revised store(Store::in_memory());
  store.add(plan({cooling(0.8), cooling(0.9)}));
  const Choice choice(store, "e = 0.8");
  const Revision seen = revision_of_cancel(store, choice, false);
  CHECK(store.job_ids().size() == 3);
  const Revision done = store.cancel(choice, false);
  REQUIRE(seen.jobs.size() == done.jobs.size());
  CHECK(seen.jobs[0].row.job_id == done.jobs[0].row.job_id);
  CHECK(seen.jobs[0].why == "is planned");
}

TEST_CASE("begun jobs end where they are stored, and done jobs stay") {
  Revised store(Store::in_memory());
  store.add(plan({cooling(0.8), cooling(0.9)}));
  equilibrate(store);
  const std::int64_t begun = begin_next(store);
  complete(store, *store.claim(me, "test"), {at(0), at(90)}, Results{});
  const Revision revision = store.cancel(Choice(store, "e < 1"), false);
  CHECK(of_job(revision, begun).fate == Fate::ends);
  CHECK(of_job(revision, begun).why == "was begun, and is stored up to tau = 30");
  CHECK(store.job(begun).tau_max == 30);
  CHECK(count(revision, Fate::kept) + count(revision, Fate::ends) == 2);
  CHECK(store.job_ids().size() == 3);
  CHECK(is_sound(store));
}

TEST_CASE("a done job is removed with its rows, and its equilibration when no job starts from it") {
  Revised store(Store::in_memory());
  store.add(plan({cooling(0.8), cooling(0.9)}));
  while (const auto claim = store.claim(me, "test"))
    complete(store, *claim, {at(0), at(30)}, Results{});
  const Revision revision = store.cancel(Choice(store, "e = 0.8"), true);
  CHECK(of_job(revision, 2).samples == 2);
  CHECK(store.job_ids() == std::vector<std::int64_t>{1, 3});
  store.cancel(Choice(store, "e = 0.9"), true);
  CHECK(store.job_ids().empty());
  for (const char* table : {"samples", "results", "checkpoints", "checkpoint_chunks", "digests"}) {
    CAPTURE(table);
    CHECK_FALSE(store.query(std::string("SELECT * FROM ") + table).next());
  }
  CHECK(is_sound(store));
}

TEST_CASE("an equilibration from which a job starts stays even when it is chosen") {
  Revised store(Store::in_memory());
  store.add(plan({cooling(0.8)}));
  const Revision revision = store.cancel(Choice(store, "kind = 'equilibration'"), true);
  CHECK(of_job(revision, 1).fate == Fate::kept);
  CHECK(of_job(revision, 1).why == "job 2 starts from it");
}

TEST_CASE("a job that is being run is left alone, and named with its worker") {
  Revised store(Store::in_memory());
  store.add(plan({cooling(0.8)}));
  equilibrate(store);
  const auto claim = store.claim(me, "test");
  const Revision revision = store.cancel(Choice(store, "e = 0.8"), true);
  CHECK(of_job(revision, 2).fate == Fate::held);
  CHECK(of_job(revision, 2).why == "is being run by process 1 on here: stop that run first");
  CHECK(complete(store, *claim) == Status::done);
}

TEST_CASE("a target is removed with the jobs that it would plan again") {
  Revised store(Store::in_memory());
  store.add(plan({cooling(0.8, 1), cooling(0.8, 2), cooling(0.9, 1), cooling(0.9, 2)}));
  store.add(std::vector<Target>{target_of(cooling(0.8)), target_of(cooling(0.9))});
  CHECK(store.cancel(Choice(store, "e = 0.8"), false).targets.size() == 1);
  REQUIRE(store.targets().size() == 1);
  CHECK(store.targets().front().series == series_identity(cooling(0.9)));
  CHECK(is_sound(store));
}

TEST_CASE("a grid replaces what is planned") {
  Revised store(Store::in_memory());
  store.add(plan({cooling(0.8), cooling(0.9), cooling(0.95)}));
  equilibrate(store);
  const std::int64_t done = [&] {
    const auto claim = store.claim(me, "test").value();
    complete(store, claim, {at(0), at(90)}, Results{});
    return claim.lease.job_id;
  }();
  const std::int64_t begun = begin_next(store);
  const auto grid = plan({cooling(0.7)}, 50);
  const Revision seen = revision_of_replace(store, grid, {});
  CHECK(store.job_ids().size() == 4);
  const Revision revision = store.replace(grid, {});
  CHECK(seen.jobs.size() == revision.jobs.size());
  CHECK(revision.outcomes == std::vector<Outcome>{Outcome::unchanged, Outcome::added});
  CHECK(count(revision, Fate::removed) == 1);
  CHECK(of_job(revision, done).fate == Fate::kept);
  CHECK(of_job(revision, begun).fate == Fate::kept);
  CHECK(store.job(begun).tau_max == 90);  // cancel ends it
  CHECK(store.find(cooling(0.7)));
  CHECK(store.job_ids().size() == 4);
  CHECK(is_sound(store));
}

TEST_CASE("a replacing grid lowers tau_max, but never below what is stored") {
  Revised store(Store::in_memory());
  store.add(plan({cooling(0.8), cooling(0.9)}));
  equilibrate(store);
  const std::int64_t begun = begin_next(store);
  CHECK(store.replace(plan({cooling(0.8), cooling(0.9)}, 20), {}).shortened.size() == 2);
  for (const JobRow& row : store.jobs())
    if (row.job.kind == Kind::cooling) CHECK(row.tau_max == (row.job_id == begun ? 30 : 20));
  CHECK(store.replace(plan({cooling(0.8), cooling(0.9)}, 20), {}).shortened.empty());
  CHECK(is_sound(store));
}

TEST_CASE("a done job stays done when tau_max is lowered") {
  Revised store(Store::in_memory());
  store.add(plan({cooling(0.8)}));
  while (const auto claim = store.claim(me, "test")) complete(store, *claim);
  CHECK(store.replace(plan({cooling(0.8)}, 20), {}).shortened.empty());
  CHECK(store.job(2).tau_max == 90);
  CHECK(store.job(2).status == Status::done);
}

TEST_CASE("seeds that a target of the grid has added stay planned, and other targets are removed") {
  Revised store(Store::in_memory());
  store.add(plan({cooling(0.8, 1), cooling(0.8, 2), cooling(0.8, 3), cooling(0.9, 1)}));
  store.add(std::vector<Target>{target_of(cooling(0.8)), target_of(cooling(0.9))});
  const Revision revision =
      store.replace(plan({cooling(0.8, 1), cooling(0.8, 2)}), {target_of(cooling(0.8))});
  CHECK(store.find(cooling(0.8, 3)));
  CHECK_FALSE(store.find(cooling(0.9, 1)));
  CHECK(revision.targets.size() == 1);
  CHECK(store.targets().size() == 1);
}

TEST_CASE("the space is given back to the disk") {
  const TemporaryFolder folder;
  Revised store(Store::create(folder / "a.db"));
  store.add(plan({cooling(0.8)}));
  while (const auto claim = store.claim(me, "test")) {
    const Commit commit{.checkpoint = Checkpoint{.tau = claim->tau_max, .state = bytes(3'000'000)},
                        .progress = {.tau = claim->tau_max}};
    store.finish(claim->lease, commit, std::nullopt, claim->tau_max);
  }
  REQUIRE(std::filesystem::file_size(folder / "a.db") > 6'000'000);
  store.cancel(Choice(store, "e = 0.8"), true);
  CHECK(store.give_back_space());
  CHECK(std::filesystem::file_size(folder / "a.db") < 500'000);
  CHECK(is_sound(store));
  store.add(plan({cooling(0.9)}));
  CHECK(Reader(folder / "a.db").job_ids().size() == 2);
}

TEST_CASE("a shard is not revised: its jobs belong to the store that lent them") {
  Revised store(Store::in_memory());
  store.add(plan({cooling(0.8)}));
  store.become_shard(std::string(32, 'a'), "shard-001");
  CHECK_THROWS_AS(store.cancel(Choice(store, "e = 0.8"), false), StoreError);
  CHECK_THROWS_AS(store.replace({}, {}), StoreError);
}
