// SPDX-License-Identifier: GPL-3.0-or-later

// Digests of rows: every write keeps them up to date, and rows that do not match are refused.
#include "schema/digests/digests.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "schema/database/database.hpp"
#include "schema/fixture.hpp"

using namespace haff::schema;

namespace {

// A job with a row in every table, in the middle of its run.
struct Working {
  TemporaryFolder folder;
  std::filesystem::path path = folder / "a.db";
  Store store = Store::create(path);
  Claim claim = begin();

  std::int64_t id() const { return claim.lease.job_id; }

 private:
  Claim begin() {
    store.add(plan({cooling()}));
    equilibrate(store);
    Claim taken = *store.claim(me, "test");
    store.commit(taken.lease, commit(0, 3));
    return taken;
  }

 public:
  static Commit commit(int from, int to) {
    Commit made{.checkpoint = Checkpoint{.tau = to * 1.0, .state = bytes(100)},
                .invariants = Invariants{.largest_overlap = 1e-9},
                .progress = {.tau = to * 1.0}};
    for (int k = from; k < to; ++k) {
      made.samples.push_back({.tau = k * 1.0, .time = 2.0 * k, .temperature = 0.5, .a2 = -0.0});
      made.profiles.push_back({.name = "S", .tau = k * 1.0, .x = {1, 2}, .value = {0.1, -0.0}});
      made.fields.push_back({.name = "density",
                             .tau = k * 1.0,
                             .cells = 2,
                             .box = 10,
                             .values = {1, 2, 3, 4, 5, 6, 7, std::nan("")}});
      made.snapshots.push_back({.tau = k * 1.0, .time = 2.0 * k, .state = bytes(100)});
    }
    return made;
  }
};

void edit_rows(const std::filesystem::path& path, const std::string& sql) {
  SQLite::Database sqlite(path.string(), SQLite::OPEN_READWRITE);
  sqlite.exec(sql);
}

}  // namespace

TEST_CASE("digests: every write keeps them up to date") {
  Working working;
  const auto all_match = [&] {
    const Reader reader(working.path);
    for (const std::int64_t job_id : reader.job_ids()) {
      const DigestsOfJob found = reader.digests(job_id);
      CHECK(found.wrong.empty());
      CHECK(found.without.empty());
    }
    CHECK(reader.wrong_tables().empty());
  };
  all_match();
  working.store.progress(working.claim.lease, {.tau = 3.5});
  all_match();
  working.store.commit(working.claim.lease, Working::commit(3, 6));
  all_match();
  working.store.fail(working.claim.lease, "for a test");
  all_match();
  working.claim = *working.store.claim(me, "test");
  working.store.finish(working.claim.lease, Working::commit(6, 9), Results{.tau_c = 5}, 90);
  all_match();
  working.store.add(plan({cooling()}, 200));
  all_match();
  CHECK(working.store.restart(working.id()));
  all_match();
  working.store.add({Target{.series = "s", .quantity = "tau_c", .se = 0.1, .pilots = {1, 2}}});
  all_match();
  working.store.drop_rows_after(working.id(), 4);
  all_match();
  CHECK(working.store.samples(working.id()).size() == 5);
}

TEST_CASE("digests: they do not depend on the division of rows into commits") {
  Working working, other;
  working.store.commit(working.claim.lease, Working::commit(3, 9));
  for (int k = 3; k < 9; ++k) other.store.commit(other.claim.lease, Working::commit(k, k + 1));
  Database one(working.path, Access::read), two(other.path, Access::read);
  for (const Part part : {Part::samples, Part::profiles, Part::fields, Part::invariants})
    CHECK(one.digests().stored(working.id(), part) == two.digests().stored(other.id(), part));
}

TEST_CASE("digests: a change in any table is seen, and its rows are refused") {
  const std::pair<const char*, Part> changes[] = {
      {"UPDATE jobs SET tau_max = 91", Part::jobs},
      {"UPDATE jobs SET host = 'x'", Part::jobs},
      {"UPDATE samples SET a2 = 1e-300 WHERE tau = 1", Part::samples},
      {"UPDATE samples SET a3 = 0 WHERE tau = 1", Part::samples},  // was NULL
      {"DELETE FROM samples WHERE tau = 2", Part::samples},
      {"UPDATE profiles SET x = 1.5 WHERE x = 1 AND tau = 1", Part::profiles},
      {"UPDATE fields SET box = 11 WHERE tau = 0", Part::fields},
      {"UPDATE fields SET data = zeroblob(64) WHERE tau = 0", Part::fields},
      {"UPDATE invariants SET past_events = 1", Part::invariants},
      {"UPDATE checkpoints SET created = '2003-09-05T12:00:00.000Z'", Part::checkpoints},
      {"INSERT INTO results SELECT job_id, 1, 2 FROM jobs", Part::results},
  };
  for (const auto& change : changes) {
    const std::string sql = change.first;
    const Part part = change.second;
    CAPTURE(sql);
    Working working;
    edit_rows(working.path, sql);
    const Reader reader(working.path);
    CHECK(reader.digests(working.id()).wrong == std::vector{part});
    const auto read = [&] {
      reader.samples(working.id());
      reader.profiles(working.id(), "S");
      reader.field(working.id(), "density", 1);
      reader.results(working.id());
      reader.invariants(working.id());
      reader.checkpoint(working.id());
    };
    if (part == Part::jobs)
      CHECK_NOTHROW(read());
    else
      CHECK_THROWS_AS(read(), Damage);
  }
}

TEST_CASE("digests: small tables have one digest") {
  Working working;
  edit_rows(working.path, "UPDATE campaign SET shard = 'mine'");
  CHECK(Reader(working.path).wrong_tables() == std::vector<std::string>{"campaign"});
  CHECK_THROWS_AS(working.store.become_shard("x", "y"), Damage);
  working.store.digest_table_again("campaign");
  CHECK(Reader(working.path).wrong_tables().empty());
}

TEST_CASE("digests: a job whose row has changed is not run, and a flipped bit is repaired") {
  const TemporaryFolder folder;
  Store store = Store::create(folder / "a.db");
  store.add(plan({cooling()}));
  equilibrate(store);
  const std::int64_t job_id = store.find(cooling()).value();
  edit_rows(folder / "a.db", "UPDATE jobs SET tau_max = 45 WHERE kind = 'cooling'");  // was 90

  CHECK_FALSE(store.claim(me, "test"));
  CHECK(store.job(job_id).status == Status::failed);
  CHECK(store.job(job_id).error.value().find("not as it was written") != std::string::npos);
  CHECK(store.retry_failed() == 0);
  CHECK(store.digests(job_id).wrong == std::vector{Part::jobs});
  CHECK_THROWS_AS(store.add(plan({cooling()}, 200)), Damage);

  const Difference turned = store.turn_bit_back(job_id).value();
  CHECK(turned.column == "tau_max");
  CHECK(turned.here == "45");
  CHECK(turned.there == "90");
  CHECK(store.job(job_id).status == Status::pending);
  CHECK_FALSE(store.job(job_id).error);
  CHECK(store.digests(job_id).wrong.empty());
  CHECK(store.claim(me, "test"));
}

TEST_CASE("digests: changing a row without a check is a logic error") {
  Working working;
  Database database(working.path, Access::write);
  CHECK_THROWS_AS(
      database.transaction([&] { database.sqlite().exec("UPDATE jobs SET tau_reached = 1"); }),
      std::logic_error);
}

TEST_CASE("digests: a merge takes them over, and refuses rows that do not match") {
  Working home, shard;
  const Reader other(shard.path);
  shard.store.commit(shard.claim.lease, Working::commit(3, 6));
  home.store.release(home.claim.lease);
  home.store.take_over(other, shard.id());
  CHECK(home.store.digests(home.id()).wrong.empty());
  CHECK(home.store.samples(home.id()).size() == 6);

  shard.store.commit(shard.claim.lease, Working::commit(6, 9));
  edit_rows(shard.path, "UPDATE samples SET temperature = 0.25 WHERE tau = 7");
  CHECK_THROWS_WITH_AS(home.store.take_over(Reader(shard.path), shard.id()),
                       doctest::Contains("its samples are not as they were written"), Damage);
  CHECK(home.store.samples(home.id()).size() == 6);
}

TEST_CASE("digests: rows are replaced only where they differ") {
  Working working, sound;
  working.store.commit(working.claim.lease, Working::commit(3, 6));
  sound.store.commit(sound.claim.lease, Working::commit(3, 6));
  edit_rows(working.path,
            "UPDATE samples SET a2 = 1 WHERE tau = 4; DELETE FROM samples WHERE tau = 5");
  const auto found =
      working.store.differences(working.id(), Part::samples, sound.store, sound.id());
  REQUIRE(found.size() == 2);
  CHECK(found[0].row == "tau = 4");
  CHECK(found[0].column == "a2");
  CHECK(found[0].here == "1");
  CHECK(found[0].there == "0");
  CHECK(found[1].row == "tau = 5");
  CHECK(found[1].here == "no row");
  CHECK(working.store.replace_rows(working.id(), Part::samples, sound.store, sound.id()) == 2);
  CHECK(working.store.samples(working.id()) == sound.store.samples(sound.id()));
}
