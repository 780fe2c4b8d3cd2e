// SPDX-License-Identifier: GPL-3.0-or-later

// Snapshots are written once, read back with every byte, and as safe as the rest of the store.
#include <SQLiteCpp/SQLiteCpp.h>
#include <doctest/doctest.h>

#include "schema/fixture.hpp"
#include "schema/store/planning/revision.hpp"
#include "schema/store/working.hpp"

using namespace haff::schema;

namespace {

Job with_snapshots(std::uint64_t seed = 1) {
  Job job = cooling(0.8, seed);
  job.snapshots_at = {.tau = {.listed = {0, 10}}, .time = {.per_decade = 2, .from = 0.1}};
  job.sample_at.tau.listed = {0.5};
  return job;
}

Snapshot snapshot_at(double tau, std::size_t size = 1000) {
  return {.tau = tau,
          .time = 2 * tau,
          .collisions = static_cast<std::int64_t>(500 * tau),
          .state = bytes(size, static_cast<unsigned>(tau))};
}

void edit_rows(const std::filesystem::path& path, const std::string& sql) {
  SQLite::Database sqlite(path.string(), SQLite::OPEN_READWRITE);
  sqlite.exec(sql);
}

std::int64_t count(const Reader& store, const std::string& table) {
  return std::get<std::int64_t>(
      store.query("SELECT count(*) FROM " + table).next().value().front());
}

}  // namespace

TEST_CASE("a job keeps the times of its samples and snapshots") {
  Store store = Store::in_memory();
  store.add(plan({with_snapshots()}));
  const JobRow row = store.job(store.find(with_snapshots()).value());
  CHECK(row.job.snapshots_at == with_snapshots().snapshots_at);
  CHECK(row.job.sample_at == with_snapshots().sample_at);
  CHECK(row.series == series_identity(with_snapshots()));
}

TEST_CASE("a store that is brought forward has the digest of an empty table of snapshots") {
  Store store = Store::in_memory();
  store.add(plan({cooling()}));
  CHECK(store.query("SELECT DISTINCT snapshots FROM digests").next() ==
        Row{std::int64_t{1238446449531573158}});
}

TEST_CASE("snapshots come back byte for byte, also those of several chunks") {
  Working working;
  const std::int64_t job_id = working.claim.lease.job_id;
  const Snapshot large = snapshot_at(10, chunk_bytes + 17);
  working.store.commit(working.claim.lease, {.snapshots = {large, snapshot_at(0)}});
  const auto infos = working.store.snapshots(job_id);
  REQUIRE(infos.size() == 2);
  CHECK(infos[0].tau == 0);
  CHECK(infos[1].tau == 10);
  CHECK(infos[1].collisions == 5000);
  CHECK(infos[1].bytes == static_cast<std::int64_t>(chunk_bytes + 17));
  const auto found = working.store.snapshot(job_id, 20);
  REQUIRE(found.has_value());
  CHECK(found->state == large.state);
  CHECK(found->tau == 10);
  CHECK_FALSE(working.store.snapshot(job_id, 21).has_value());
}

TEST_CASE("a snapshot that is computed again is compared, and the first one is kept") {
  Working working;
  const Lease& lease = working.claim.lease;
  working.store.commit(lease, {.snapshots = {snapshot_at(1)}});
  working.store.commit(lease, {.snapshots = {snapshot_at(1), snapshot_at(2)}});
  CHECK(working.store.snapshots(lease.job_id).size() == 2);
  Snapshot other = snapshot_at(1);
  other.state[7] ^= std::byte{1};
  CHECK(refusal([&] {
          working.store.commit(lease, {.snapshots = {snapshot_at(3), other}});
        }).find("the snapshot at tau = 1 came out different") != std::string::npos);
  CHECK(working.store.snapshots(lease.job_id).size() == 2);  // the whole commit is undone
}

TEST_CASE("damage to a snapshot is found") {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  Working working(Store::create(path));
  const std::int64_t job_id = working.claim.lease.job_id;
  working.store.commit(working.claim.lease, {.snapshots = {snapshot_at(1)}});
  const auto said = [&] { return refusal([&] { working.store.snapshot(job_id, 2); }); };

  edit_rows(path, "UPDATE snapshot_chunks SET bytes = zeroblob(1000)");
  CHECK(said().find("the snapshot of job") != std::string::npos);
  CHECK(said().find("do not add up to its checksum") != std::string::npos);
  edit_rows(path, "DELETE FROM snapshot_chunks");
  CHECK(said().find("it holds 0 bytes of 1000") != std::string::npos);
  edit_rows(path, "UPDATE snapshots SET tau = 3");
  CHECK(said().find("its snapshots are not as they were written") != std::string::npos);
  CHECK(working.store.digests(job_id).wrong == std::vector{Part::snapshots});
}

TEST_CASE("snapshots are removed with their job, and with rows that are dropped") {
  Revised store(Store::in_memory());
  store.add(plan({cooling()}));
  equilibrate(store);
  const Claim claim = *store.claim(me, "test");
  store.commit(claim.lease, {.snapshots = {snapshot_at(1), snapshot_at(5), snapshot_at(9)}});
  store.release(claim.lease);
  store.drop_rows_after(claim.lease.job_id, 5);
  CHECK(store.snapshots(claim.lease.job_id).size() == 2);
  CHECK(count(store, "snapshot_chunks") == 2);
  CHECK(store.digests(claim.lease.job_id).wrong.empty());
  store.cancel(Choice(store, "e = 0.8"), true);
  CHECK(count(store, "snapshots") == 0);
  CHECK(count(store, "snapshot_chunks") == 0);
  CHECK(store.faults().empty());
}

TEST_CASE("snapshots are taken over from another store, and compared") {
  Working there;
  const std::int64_t job_id = there.claim.lease.job_id;
  there.store.commit(there.claim.lease,
                     {.snapshots = {snapshot_at(1), snapshot_at(2, chunk_bytes + 5)}});
  there.store.release(there.claim.lease);
  Store here = Store::in_memory();
  for (const std::int64_t each : there.store.job_ids()) here.take_over(there.store, each);
  CHECK(here.snapshot(job_id, 4)->state == snapshot_at(2, chunk_bytes + 5).state);
  CHECK(here.digests(job_id).wrong.empty());
  CHECK(here.take_over(there.store, job_id).rows == 0);

  Working other;
  Snapshot different = snapshot_at(2);
  other.store.commit(other.claim.lease, {.snapshots = {different}});
  other.store.release(other.claim.lease);
  CHECK(refusal([&] { other.store.take_over(there.store, job_id); }).find("differ in bytes") !=
        std::string::npos);
}

TEST_CASE("a snapshot that a second computation found wrong is replaced, with its bytes") {
  const TemporaryFolder folder;
  Working here(Store::create(folder / "a.db")), there;
  const std::int64_t job_id = here.claim.lease.job_id;
  for (Working* each : {&here, &there})
    each->store.commit(each->claim.lease, {.snapshots = {snapshot_at(1), snapshot_at(2)}});
  edit_rows(folder / "a.db",
            "UPDATE snapshot_chunks SET bytes = zeroblob(3) WHERE time = 2;"
            "UPDATE snapshots SET collisions = 7 WHERE time = 4");
  here.store.replace_rows(job_id, Part::snapshots, there.store, job_id);
  CHECK(here.store.snapshot(job_id, 2)->state == snapshot_at(1).state);
  CHECK(here.store.snapshot(job_id, 4)->collisions == 1000);
  CHECK(here.store.digests(job_id).wrong.empty());
}
