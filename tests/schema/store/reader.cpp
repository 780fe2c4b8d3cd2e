// SPDX-License-Identifier: GPL-3.0-or-later

// Data are read back whole, or reported as damaged: damaged data are never used.
#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "schema/database/database.hpp"
#include "schema/fixture.hpp"

using namespace haff::schema;

namespace {

// A store with one checkpoint of two chunks, and a connection that damages it.
struct Vandal {
  TemporaryFolder folder;
  Store store = Store::create(folder / "a.db");
  SQLite::Database sqlite{(folder / "a.db").string(), SQLite::OPEN_READWRITE};
  Checkpoint checkpoint;
  std::int64_t job_id = 0;

  explicit Vandal(std::size_t state = chunk_bytes + 1000)
      : checkpoint{.tau = 30, .collisions = 15000, .state = bytes(state, 7)} {
    store.add(plan({cooling()}));
    const Claim claim = *store.claim(me, "test");
    job_id = claim.lease.job_id;
    store.commit(claim.lease, {.checkpoint = checkpoint});
  }

  std::string complaint() const {
    try {
      store.checkpoint(job_id);
    } catch (const Damage& damage) {
      return damage.what();
    }
    return "no complaint";
  }

  std::string damaged(const std::string& what) const {
    return store.path().string() + ": the checkpoint of job " + std::to_string(job_id) +
           " is damaged: " + what;
  }
};

}  // namespace

TEST_CASE("a checkpoint is cut into chunks and put together again") {
  const Vandal vandal;
  const auto read = vandal.store.checkpoint(vandal.job_id);
  REQUIRE(read);
  CHECK(read->tau == 30);
  CHECK(read->collisions == 15000);
  CHECK(read->state == vandal.checkpoint.state);
  Query chunks = vandal.store.query("SELECT position, length(bytes) FROM checkpoint_chunks");
  const auto chunk = static_cast<std::int64_t>(chunk_bytes);
  CHECK(chunks.next() == Row{std::int64_t{0}, chunk});
  CHECK(chunks.next() == Row{std::int64_t{1}, std::int64_t{1000}});
  CHECK_FALSE(chunks.next());
}

TEST_CASE("only the newest checkpoint is kept") {
  Vandal vandal;
  const Lease lease = vandal.store.running()[0].lease;
  vandal.store.commit(lease, {.checkpoint = Checkpoint{.tau = 40, .state = bytes(10)}});
  CHECK(vandal.store.checkpoint(vandal.job_id)->state == bytes(10));
  CHECK(vandal.sqlite.execAndGet("SELECT count(*) FROM checkpoint_chunks").getInt() == 1);
  const auto infos = vandal.store.checkpoints();
  REQUIRE(infos.size() == 1);
  CHECK(infos[0].tau == 40);
  CHECK(infos[0].bytes == 10);
}

TEST_CASE("no checkpoint is found for a job without one") {
  const Vandal vandal;
  CHECK_FALSE(vandal.store.checkpoint(vandal.job_id + 1));
}

TEST_CASE("a flipped bit is found") {
  Vandal vandal;
  auto chunk = std::span(vandal.checkpoint.state).first(chunk_bytes);
  chunk[12345] ^= std::byte{4};
  SQLite::Statement flip(vandal.sqlite,
                         "UPDATE checkpoint_chunks SET bytes = ? WHERE position = 0");
  flip.bind(1, chunk.data(), static_cast<int>(chunk.size()));
  flip.exec();
  CHECK(vandal.complaint() == vandal.damaged("its bytes do not add up to its checksum"));
}

TEST_CASE("a truncated chunk is found") {
  Vandal vandal;
  vandal.sqlite.exec(
      "UPDATE checkpoint_chunks SET bytes = substr(bytes, 1, 999) WHERE position = 1");
  CHECK(vandal.complaint() == vandal.damaged("it holds 16778215 bytes of 16778216"));
}

TEST_CASE("a missing chunk is found") {
  Vandal vandal;
  vandal.sqlite.exec("DELETE FROM checkpoint_chunks WHERE position = 0");
  CHECK(vandal.complaint() == vandal.damaged("it holds 1000 bytes of 16778216"));
  vandal.sqlite.exec("DELETE FROM checkpoint_chunks");
  CHECK(vandal.complaint() == vandal.damaged("it holds 0 bytes of 16778216"));
}

TEST_CASE("chunks in the wrong order are found") {
  Vandal vandal;
  vandal.sqlite.exec("UPDATE checkpoint_chunks SET position = -1 WHERE position = 0");
  vandal.sqlite.exec("UPDATE checkpoint_chunks SET position = 0 WHERE position = 1");
  vandal.sqlite.exec("UPDATE checkpoint_chunks SET position = 1 WHERE position = -1");
  CHECK(vandal.complaint() == vandal.damaged("its bytes do not add up to its checksum"));
}

TEST_CASE("a sound store has no faults") {
  const Vandal vandal;
  CHECK(vandal.store.faults().empty());
}

TEST_CASE("rows that refer to nothing are faults") {
  Vandal vandal;
  vandal.sqlite.exec("PRAGMA foreign_keys = OFF");
  vandal.sqlite.exec("INSERT INTO results VALUES (77, NULL, NULL)");
  CHECK(vandal.store.faults().file ==
        std::vector<std::string>{"results row 77 refers to a row that is missing in jobs"});
}

TEST_CASE("a damaged file is reported, not read") {
  Vandal vandal;
  vandal.sqlite.exec("PRAGMA wal_checkpoint(TRUNCATE)");
  const int root =
      vandal.sqlite.execAndGet("SELECT rootpage FROM sqlite_schema WHERE name = 'jobs'").getInt();
  const auto page = vandal.sqlite.execAndGet("PRAGMA page_size").getInt();
  const auto path = vandal.folder / "b.db";
  std::filesystem::copy_file(vandal.folder / "a.db", path);
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(std::streamoff{root - 1} * page);
    file << std::string(static_cast<std::size_t>(page), 'x');
  }
  const Reader reader(path);
  CHECK_THROWS_AS(reader.jobs(), Damage);
  CHECK_FALSE(reader.faults().empty());
}

TEST_CASE("a job that does not exist is named") {
  const Vandal vandal;
  CHECK_THROWS_WITH_AS(vandal.store.job(99),
                       (vandal.store.path().string() + ": there is no job 99").c_str(), StoreError);
}

// Text that could reach a terminal, a figure or a page, and numbers that libraries cannot handle.
TEST_CASE(
    "values that this program does not write in a row of jobs are damage, and the column is "
    "named") {
  const auto complaint = [](const std::string& change) {
    Vandal vandal(1000);
    vandal.sqlite.exec("PRAGMA ignore_check_constraints = ON");
    vandal.sqlite.exec("UPDATE jobs SET " + change);
    try {
      vandal.store.jobs();
    } catch (const Damage& damage) {
      return std::string(damage.what());
    }
    return std::string("no complaint");
  };
  for (const std::string change :
       {"code_version = 'x' || char(10) || 'system(\"true\")'", "host = char(27) || '[2J'",
        "error = 'a' || char(7)", "created = 'yesterday'", "d = 9007199254740992",
        "particles = 4294967296", "particles = -1", "seed = -1", "n = 9e999", "tau_max = 1e300",
        "sample_every = 5e-324", "effects = '[1,2'", "effects = '{\"shuffle\":5}'",
        "effects = '{\"shuffle\":{\"every\":\"x\"}}'", "observables = '{}'", "fields_at = '[null]'",
        "code_version = char(155)"}) {
    CAPTURE(change);
    const std::string said = complaint(change);
    CHECK(said.find(change.substr(0, change.find(' '))) != std::string::npos);
  }
}

TEST_CASE("an error with control characters is stored without them") {
  Vandal vandal;
  vandal.store.fail({vandal.job_id, 1}, "two\nlines, \x1b[2J, \xff and µ");
  CHECK(vandal.store.job(vandal.job_id).error == "two lines,  [2J,   and µ");
}

TEST_CASE("jobs are listed by kind, physics and seed, in whatever order they were planned") {
  Store store = Store::in_memory();
  store.add(plan({cooling(0.9, 2), cooling(0.8, 10), cooling(0.9, 1), cooling(0.8, 9)}));
  std::vector<std::pair<std::optional<double>, std::uint64_t>> order;
  for (const JobRow& row : store.jobs()) order.emplace_back(row.job.e, row.job.seed);
  CHECK(order == std::vector<std::pair<std::optional<double>, std::uint64_t>>{
                     {1, 1}, {1, 2}, {1, 9}, {1, 10}, {0.8, 9}, {0.8, 10}, {0.9, 1}, {0.9, 2}});
}

TEST_CASE("a summary counts jobs and time") {
  Store store = Store::in_memory();
  auto jobs = plan({cooling(0.8), cooling(0.9)});
  for (Planned& planned : jobs) planned.expected_cpu_seconds = 100;
  store.add(jobs);
  equilibrate(store);
  const Claim claim = *store.claim(me, "test");
  store.progress(claim.lease, {.tau = 45, .cpu_seconds = 60});
  Summary summary = store.summary();
  CHECK(summary.jobs[Status::done] == 1);
  CHECK(summary.jobs[Status::running] == 1);
  CHECK(summary.jobs[Status::pending] == 1);
  CHECK(summary.jobs[Status::failed] == 0);
  CHECK(summary.jobs.size() == statuses.size());
  CHECK(summary.claimable == 1);
  CHECK(summary.cpu_seconds == 60);
  CHECK(summary.expected_cpu_seconds == 300);
  CHECK(summary.remaining_cpu_seconds == 150);
}
