// SPDX-License-Identifier: GPL-3.0-or-later

// A backup is the store at one moment, in one file, whatever else happens to the store meanwhile.
#include "schema/database/backup.hpp"

#include <doctest/doctest.h>

#include <string>
#include <thread>

#include "schema/fixture.hpp"

using namespace haff::schema;

TEST_CASE("a backup has all that is in the store's log, and its jobs are held by no process") {
  const TemporaryFolder folder;
  Store store = Store::create(folder / "a.db");
  store.open_log();
  store.add(plan({cooling()}));
  const Claim claim = *store.claim(me, "test");
  const Checkpoint checkpoint{.tau = 10, .collisions = 5000, .state = bytes(100'000)};
  store.commit(claim.lease, {.samples = {{.tau = 0, .time = 0, .temperature = 1}},
                             .checkpoint = checkpoint,
                             .progress = {.tau = 10, .collisions = 5000}});
  store.progress(claim.lease, {.tau = 12, .collisions = 6000});

  const auto size = Reader(folder / "a.db").back_up(folder / "b.db");
  CHECK(size == std::filesystem::file_size(folder / "b.db"));
  Store copy = Store::open(folder / "b.db");
  CHECK(copy.samples(claim.lease.job_id).size() == 1);
  CHECK(copy.checkpoint(claim.lease.job_id)->state == checkpoint.state);
  CHECK(copy.job(claim.lease.job_id).status == Status::pending);
  CHECK(copy.job(claim.lease.job_id).progress.tau == 10);
  CHECK(copy.claim(me, "test"));
  CHECK(store.job(claim.lease.job_id).status == Status::running);
  CHECK_FALSE(std::filesystem::exists(folder / "b.db-wal"));
  CHECK_FALSE(std::filesystem::exists(folder / "b.db-journal"));
}

TEST_CASE("a backup does not replace a file") {
  const TemporaryFolder folder;
  Store::create(folder / "a.db").add(plan({cooling()}));
  Store::create(folder / "b.db");
  CHECK_THROWS_AS(Reader(folder / "a.db").back_up(folder / "b.db"), NameError);
  CHECK_THROWS_AS(Reader(folder / "a.db").back_up(folder / "a.db"), NameError);
  CHECK_THROWS_AS(Reader(folder / "a.db").back_up(folder / "no/b.db"), NameError);
  CHECK(Reader(folder / "b.db").jobs().empty());
}

TEST_CASE("backups that are taken while others write are each one moment of the store") {
  const TemporaryFolder folder;
  Store store = Store::create(folder / "a.db");
  store.open_log();
  store.add(plan({cooling()}));
  const Claim claim = *store.claim(me, "test");
  std::jthread writer([&](const std::stop_token& stop) {
    Store mine = Store::open(folder / "a.db");
    // Each copy has both the sample and the checkpoint of a commit, or neither.
    for (int k = 1; !stop.stop_requested(); ++k) {
      const double tau = k;
      mine.commit(claim.lease, {.samples = {{.tau = tau, .time = tau, .temperature = 1}},
                                .checkpoint = Checkpoint{.tau = tau, .state = bytes(300'000)},
                                .progress = {.tau = tau}});
      if (k % 5 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  for (int k = 0; k < 10; ++k) {
    const auto to = folder / ("copy-" + std::to_string(k));
    Reader(folder / "a.db").back_up(to);
    const Reader copy(to);
    CHECK(copy.faults().empty());
    const auto samples = copy.samples(claim.lease.job_id);
    const auto checkpoint = copy.checkpoint(claim.lease.job_id);
    CHECK(samples.empty() == !checkpoint.has_value());
    if (checkpoint) CHECK(samples.back().tau == checkpoint->tau);
  }
}

TEST_CASE("a damaged store is not backed up") {
  const TemporaryFolder folder;
  Store::create(folder / "a.db").add(plan({cooling()}));
  {
    SQLite::Database vandal((folder / "a.db").string(), SQLite::OPEN_READWRITE);
    vandal.exec(
        "PRAGMA writable_schema = ON; UPDATE sqlite_schema SET rootpage = (SELECT rootpage "
        "FROM sqlite_schema WHERE name = 'samples') WHERE name = 'profiles'");
  }
  CHECK_THROWS_AS(Reader(folder / "a.db").back_up(folder / "b.db"), Damage);
  int files = 0;
  for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(folder.path()))
    ++files;
  CHECK(files == 1);
}
