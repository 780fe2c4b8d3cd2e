// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/store/shards.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <string_view>
#include <vector>

#include "schema/database/database.hpp"
#include "schema/store/rows/bind.hpp"
#include "schema/store/rows/checked_rows.hpp"
#include "schema/store/rows/job_rows.hpp"
#include "schema/store/store.hpp"

namespace haff::schema {
namespace {

// Tables whose rows are written once and never change, and those that hold the newest state of a
// job. All have a column job_id.
constexpr std::array written_once{Part::samples, Part::profiles, Part::fields, Part::snapshots};
constexpr std::array newest_state{"checkpoints", "checkpoint_chunks", "invariants", "results"};
constexpr std::array all_parts{Part::jobs,        Part::samples, Part::profiles,
                               Part::fields,      Part::results, Part::invariants,
                               Part::checkpoints, Part::loans,   Part::snapshots};

// Columns of jobs that belong to this store, not to the job.
const std::set<std::string> of_this_store{"job_id",        "equilibration_id", "status",
                                          "lease",         "owner_boot_id",    "owner_pid",
                                          "owner_started", "renewed"};

// Columns of jobs that say how far the job is, and where it was worked on.
constexpr std::array progress_columns{"tau_reached", "collisions",     "attempts", "error",
                                      "starts_over", "started",        "finished", "code_version",
                                      "host",        "physics_version"};

// ---- jobs -------------------------------------------------------------------------------------

JobRow row_of(SQLite::Database& sqlite, std::int64_t job_id) {
  SQLite::Statement statement(sqlite, "SELECT * FROM jobs WHERE job_id = ?");
  statement.bind(1, job_id);
  if (!statement.executeStep())
    throw std::logic_error(fmt::format("there is no job {} to take over", job_id));
  return job_row(statement);
}

std::optional<std::int64_t> id_of(SQLite::Database& sqlite, const std::string& identity) {
  SQLite::Statement statement(sqlite, "SELECT job_id FROM jobs WHERE identity = ?");
  statement.bind(1, identity);
  if (!statement.executeStep()) return std::nullopt;
  return integer(statement, "job_id");
}

std::string identity_of(SQLite::Database& sqlite, std::int64_t job_id) {
  SQLite::Statement statement(sqlite, "SELECT identity FROM jobs WHERE job_id = ?");
  statement.bind(1, job_id);
  statement.executeStep();
  return text(statement, "identity");
}

// Adds a job of the shard's, as one that has not begun; its equilibration must be here already.
std::int64_t add_job(SQLite::Database& ours, SQLite::Database& theirs, std::int64_t their_id) {
  std::vector<std::string> columns = table_of(theirs, "jobs").columns;
  std::erase_if(columns, [](const std::string& name) { return of_this_store.contains(name); });
  const JobRow row = row_of(theirs, their_id);
  std::optional<std::int64_t> start;
  if (row.equilibration_id) start = id_of(ours, identity_of(theirs, *row.equilibration_id));

  SQLite::Statement from(theirs,
                         fmt::format("SELECT {} FROM jobs WHERE job_id = ?", list(columns, "{}")));
  from.bind(1, their_id);
  from.executeStep();
  SQLite::Statement insert(
      ours, fmt::format("INSERT INTO jobs (equilibration_id, {}) VALUES (:equilibration_id, {})",
                        list(columns, "{}"), list(columns, ":{}")));
  if (start) insert.bind(":equilibration_id", *start);
  for (int i = 0; i < from.getColumnCount(); ++i)
    bind_value(insert, insert.getIndex((":" + columns[static_cast<std::size_t>(i)]).c_str()),
               from.getColumn(i));
  insert.exec();

  const std::int64_t job_id = ours.getLastInsertRowid();
  SQLite::Statement fresh(
      ours,
      "UPDATE jobs SET tau_reached = 0, collisions = 0, attempts = 0, error = NULL, "
      "started = NULL, finished = NULL WHERE job_id = ?");
  fresh.bind(1, job_id);
  fresh.exec();
  return job_id;
}

bool has_ended(Status status) {
  return status == Status::done || status == Status::collapsed || status == Status::failed;
}

// tau up to which a job is kept: its end, or its newest state. The tau of a running job is only
// what its worker last reported.
double kept_tau(SQLite::Database& sqlite, const JobRow& row) {
  if (row.starts_over) return 0;
  if (has_ended(row.status) && row.status != Status::failed) return row.progress.tau;
  SQLite::Statement statement(sqlite, "SELECT tau FROM checkpoints WHERE job_id = ?");
  statement.bind(1, row.job_id);
  return statement.executeStep() ? statement.getColumn(0).getDouble() : 0;
}

// The status of our job after it has taken over theirs. A job that a plan has made longer meanwhile
// is not done, and one that is unfinished in the other store keeps its status.
Status status_after(const JobRow& ours, const JobRow& theirs) {
  if (!has_ended(theirs.status)) return ours.status;
  if (theirs.status == Status::failed)
    return ours.status == Status::done ? Status::done : Status::failed;
  if (theirs.status == Status::done && ours.tau_max > theirs.tau_max)
    return has_ended(ours.status) ? ours.status : Status::pending;
  return theirs.status;
}

void take_state(const RowsOfJob& ours, const RowsOfJob& theirs) {
  for (const char* table : {"checkpoint_chunks", "checkpoints", "invariants", "results"})
    drop_rows(ours, table);
  for (const char* table : newest_state) add_rows(ours, theirs, table);
}

void take_progress(const RowsOfJob& ours, const RowsOfJob& theirs, Status status) {
  std::vector<std::string> columns(progress_columns.begin(), progress_columns.end());
  SQLite::Statement from(theirs.sqlite(),
                         fmt::format("SELECT {} FROM jobs WHERE job_id = ?", list(columns, "{}")));
  from.bind(1, theirs.job_id);
  from.executeStep();
  SQLite::Statement update(
      ours.sqlite(), fmt::format("UPDATE jobs SET {}, status = :status, lease = lease + 1, "
                                 "owner_boot_id = NULL, owner_pid = NULL, owner_started = NULL, "
                                 "renewed = NULL WHERE job_id = :job_id",
                                 list(columns, "{0} = :{0}")));
  for (int i = 0; i < from.getColumnCount(); ++i)
    bind_value(update, update.getIndex((":" + columns[static_cast<std::size_t>(i)]).c_str()),
               from.getColumn(i));
  update.bind(":status", std::string(name(status)));
  update.bind(":job_id", ours.job_id);
  update.exec();
}

// Adds what this shard has spent on the job since it was last merged.
void take_cost(Database& database, const std::string& shard, std::int64_t job_id,
               double cpu_seconds) {
  SQLite::Database& sqlite = database.sqlite();
  database.digests().must_match(job_id, Part::loans);
  SQLite::Statement add(sqlite, R"(
    UPDATE jobs SET cpu_seconds = cpu_seconds + max(0, :cpu_seconds - cpu_seconds_before) -
                                  cpu_seconds_spent
    FROM loans
    WHERE loans.shard = :shard AND loans.job_id = jobs.job_id AND jobs.job_id = :job_id)");
  add.bind(":shard", shard);
  add.bind(":job_id", job_id);
  add.bind(":cpu_seconds", cpu_seconds);
  add.exec();
  SQLite::Statement spent(sqlite,
                          "UPDATE loans SET cpu_seconds_spent = max(0, ? - cpu_seconds_before) "
                          "WHERE shard = ? AND job_id = ?");
  spent.bind(1, cpu_seconds);
  spent.bind(2, shard);
  spent.bind(3, job_id);
  spent.exec();
  database.digests().changed(job_id, Part::loans);
}

Shard shard_of(const SQLite::Statement& row) {
  return {.name = text(row, "shard"),
          .path = text(row, "path"),
          .lent = text(row, "lent"),
          .merged = optional_text(row, "merged"),
          .returned = optional_text(row, "returned"),
          .jobs = integer(row, "jobs"),
          .unfinished = integer(row, "unfinished"),
          .cpu_seconds = real(row, "cpu_seconds")};
}

void must_be_known(SQLite::Database& sqlite, const std::filesystem::path& path,
                   const std::string& shard) {
  SQLite::Statement statement(sqlite, "SELECT 1 FROM shards WHERE shard = ?");
  statement.bind(1, shard);
  if (!statement.executeStep())
    throw StoreError(path.string() + ": has lent nothing to a shard named " + shard);
}

}  // namespace

std::string Reader::campaign_id() const {
  return database_->guarded([&] {
    return database_->sqlite().execAndGet("SELECT campaign_id FROM campaign").getString();
  });
}

std::optional<std::string> Reader::shard_name() const {
  return database_->guarded([&]() -> std::optional<std::string> {
    const auto shard = database_->sqlite().execAndGet("SELECT shard FROM campaign");
    if (shard.isNull()) return std::nullopt;
    return shard.getString();
  });
}

std::vector<Shard> Reader::shards() const {
  return database_->guarded([&] {
    SQLite::Statement statement(database_->sqlite(), R"(
      SELECT shards.*, count(loans.job_id) AS jobs,
             count(*) FILTER (WHERE jobs.status = 'lent') AS unfinished,
             total(loans.cpu_seconds_spent) AS cpu_seconds
      FROM shards LEFT JOIN loans USING (shard) LEFT JOIN jobs USING (job_id)
      GROUP BY shard ORDER BY shard)");
    std::vector<Shard> shards;
    while (statement.executeStep()) shards.push_back(shard_of(statement));
    return shards;
  });
}

void Store::lend(const std::vector<Loan>& loans) {
  database().transaction([&] {
    SQLite::Database& sqlite = database().sqlite();
    database().digests().must_match_table("shards");
    std::set<std::int64_t> lent_now;
    for (const Loan& loan : loans) {
      SQLite::Statement shard(sqlite,
                              "INSERT INTO shards (shard, path, lent) VALUES (?, ?, " + now + ")");
      shard.bind(1, loan.shard);
      shard.bind(2, loan.path.string());
      shard.exec();
      for (const std::int64_t job_id : loan.jobs) {
        const JobRow row = row_of(sqlite, job_id);
        if (row.status == Status::done) continue;  // an equilibration that jobs start from
        if (row.status != Status::pending && !lent_now.contains(job_id))
          throw StoreError(fmt::format("{}: job {} is {} meanwhile; give the same command again",
                                       path().string(), job_id, name(row.status)));
        if (lent_now.insert(job_id).second) {
          database().digests().must_match(job_id, Part::jobs);
          database().digests().must_match(job_id, Part::loans);
        }
        SQLite::Statement lend(sqlite, "UPDATE jobs SET status = 'lent' WHERE job_id = ?");
        lend.bind(1, job_id);
        lend.exec();
        SQLite::Statement note(
            sqlite, "INSERT INTO loans (shard, job_id, cpu_seconds_before) VALUES (?, ?, ?)");
        note.bind(1, loan.shard);
        note.bind(2, job_id);
        note.bind(3, row.progress.cpu_seconds);
        note.exec();
        database().digests().changed(job_id, Part::loans);
      }
    }
  });
}

void Store::become_shard(const std::string& campaign_id, const std::string& name) {
  // A shard gets its name when all of it is on the disk. No commit before that need wait for the
  // disk, which each would do five times.
  database().guarded([&] { database().sqlite().exec("PRAGMA synchronous = OFF"); });
  database().transaction([&] {
    database().digests().must_match_table("campaign");
    SQLite::Statement statement(database().sqlite(),
                                "UPDATE campaign SET campaign_id = ?, shard = ?");
    statement.bind(1, campaign_id);
    statement.bind(2, name);
    statement.exec();
  });
}

Arrival Store::take_over(const Reader& other, std::int64_t job_id, const std::string& shard) {
  return other.database().snapshot([&] {
    for (const Part part : all_parts) other.database().digests().must_match(job_id, part);
    return database().transaction([&] {
      SQLite::Database& sqlite = database().sqlite();
      Digests& digests = database().digests();
      const RowsOfJob theirs{other.database(), job_id};
      const auto known = id_of(sqlite, identity_of(theirs.sqlite(), job_id));
      if (known) digests.must_match(*known, Part::jobs);
      const std::int64_t our_id = known ? *known : add_job(sqlite, theirs.sqlite(), job_id);
      const RowsOfJob ours{database(), our_id};
      const JobRow here = row_of(sqlite, our_id), there = row_of(theirs.sqlite(), job_id);

      Arrival arrival;
      for (const Part part : written_once) {
        arrival.rows += add_and_compare_rows(ours, theirs, part);
        if (const char* chunks = chunks_of(part)) add_rows(ours, theirs, chunks);
        // Rows without a digest there get none here.
        if (!other.database().digests().stored(job_id, part)) digests.forget(our_id, part);
      }
      const double our_tau = kept_tau(sqlite, here), their_tau = kept_tau(theirs.sqlite(), there);
      const bool has_ended_there = has_ended(there.status) && !has_ended(here.status);
      arrival.advanced = their_tau > our_tau || (their_tau == our_tau && has_ended_there);
      if (arrival.advanced) {
        take_state(ours, theirs);
        take_progress(ours, theirs, status_after(here, there));
      } else if (their_tau == our_tau) {
        add_and_compare_rows(ours, theirs, Part::results);
      }
      if (!shard.empty()) take_cost(database(), shard, our_id, there.progress.cpu_seconds);
      return arrival;
    });
  });
}

void Store::note_merge(const std::string& shard) {
  database().transaction([&] {
    SQLite::Database& sqlite = database().sqlite();
    must_be_known(sqlite, path(), shard);
    database().digests().must_match_table("shards");
    SQLite::Statement statement(sqlite, "UPDATE shards SET merged = " + now +
                                            R"(, returned = coalesce(returned, iif(EXISTS (
          SELECT 1 FROM loans JOIN jobs USING (job_id)
          WHERE loans.shard = :shard AND jobs.status = 'lent'), NULL, )" +
                                            now + R"())
      WHERE shard = :shard)");
    statement.bind(":shard", shard);
    statement.exec();
  });
}

std::int64_t Store::recall(const std::string& shard) {
  return database().transaction([&] {
    SQLite::Database& sqlite = database().sqlite();
    must_be_known(sqlite, path(), shard);
    database().digests().must_match_table("shards");
    SQLite::Statement back(
        sqlite, "UPDATE shards SET returned = coalesce(returned, " + now + ") WHERE shard = ?");
    back.bind(1, shard);
    back.exec();
    SQLite::Statement jobs(sqlite, R"(
      SELECT job_id FROM jobs
      WHERE status = 'lent' AND job_id IN (SELECT job_id FROM loans WHERE shard = :shard)
        AND NOT EXISTS (SELECT 1 FROM loans JOIN shards USING (shard)
                        WHERE loans.job_id = jobs.job_id AND shards.returned IS NULL))");
    jobs.bind(":shard", shard);
    std::vector<std::int64_t> recalled;
    while (jobs.executeStep()) recalled.push_back(integer(jobs, "job_id"));
    SQLite::Statement recall(sqlite, "UPDATE jobs SET status = 'pending' WHERE job_id = ?");
    for (const std::int64_t job_id : recalled) {
      database().digests().must_match(job_id, Part::jobs);
      recall.reset();
      recall.bind(1, job_id);
      recall.exec();
    }
    return static_cast<std::int64_t>(recalled.size());
  });
}

}  // namespace haff::schema
