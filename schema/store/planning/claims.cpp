// SPDX-License-Identifier: GPL-3.0-or-later

// Which worker holds a job: claiming, giving back, failing, reopening.
#include <limits>

#include "schema/database/database.hpp"
#include "schema/store/lease.hpp"
#include "schema/store/planning/claiming.hpp"
#include "schema/store/rows/bind.hpp"
#include "schema/store/rows/checked_rows.hpp"
#include "schema/store/store.hpp"

namespace haff::schema {

namespace {

std::vector<std::int64_t> ids(SQLite::Database& sqlite, const char* sql) {
  SQLite::Statement statement(sqlite, sql);
  std::vector<std::int64_t> found;
  while (statement.executeStep()) found.push_back(statement.getColumn(0).getInt64());
  return found;
}

}  // namespace

void bind_fit(SQLite::Statement& statement, const std::optional<Fit>& fit) {
  statement.bind(":seconds", fit ? fit->seconds : std::numeric_limits<double>::max());
  statement.bind(":tau", fit ? fit->tau : 0);
}

std::optional<Claim> claim_first(Database& database, const std::string& select, const Owner& owner,
                                 const std::string& code_version, const std::optional<Fit>& fit) {
  Prepared next(database, select);
  bind_fit(next, fit);
  std::int64_t job_id = 0;
  do {
    next.reset();
    if (!next.executeStep()) return std::nullopt;
    job_id = next.getColumn(0).getInt64();
    next.reset();
  } while (!is_as_written(database, job_id));

  Prepared statement(database, R"(
    UPDATE jobs SET status = 'running', lease = lease + 1, host = :host,
                    owner_boot_id = :boot_id, owner_pid = :pid, owner_started = :started,
                    code_version = :code_version, renewed = )" +
                                   now + R"(,
                    started = coalesce(started, )" +
                                   now +
                                   R"()
    WHERE job_id = :job_id
    RETURNING *)");
  statement.bind(":host", owner.host);
  statement.bind(":boot_id", owner.boot_id);
  statement.bind(":pid", owner.pid);
  statement.bind(":started", owner.started);
  statement.bind(":code_version", code_version);
  statement.bind(":job_id", job_id);
  statement.executeStep();
  const JobRow row = job_row(statement);
  return Claim{.lease = {row.job_id, integer(statement, "lease")},
               .job = row.job,
               .tau_max = row.tau_max,
               .checkpoint_every = row.checkpoint_every,
               .equilibration_id = row.equilibration_id,
               .attempts = row.attempts,
               .cpu_seconds = row.progress.cpu_seconds,
               .starts_over = row.starts_over};
}

std::optional<Claim> Store::claim(const Owner& owner, const std::string& code_version,
                                  const std::optional<Fit>& fit) {
  return database().transaction([&] {
    const std::string select = "SELECT jobs.job_id " + std::string(from_claimable_jobs) + "AND " +
                               seconds_to_next_tau + " <= :seconds ORDER BY " + usual_order +
                               " LIMIT 1";
    return claim_first(database(), select, owner, code_version, fit);
  });
}

void Store::progress(const Lease& lease, const Progress& progress) {
  database().transaction([&] {
    must_hold(database(), lease);
    note_progress(database(), lease, progress);
  });
}

Status Store::fail(const Lease& lease, const std::string& error, bool again) {
  return database().transaction([&] {
    if (!is_held(database(), lease)) return Status::failed;
    Prepared statement(database(), R"(
      UPDATE jobs SET attempts = attempts + 1, error = :error WHERE job_id = :job_id
      RETURNING attempts)");
    statement.bind(":error", printable(error));
    statement.bind(":job_id", lease.job_id);
    statement.executeStep();
    const bool last = !again || integer(statement, "attempts") >= max_attempts;
    const Status status = last ? Status::failed : Status::pending;
    leave(database(), lease, status);
    return status;
  });
}

void Store::release(const Lease& lease) {
  database().transaction([&] {
    if (is_held(database(), lease)) leave(database(), lease, Status::pending);
  });
}

bool Store::reclaim(const Lease& lease) {
  return database().transaction([&] {
    const bool held = holds(database(), lease);
    if (held && is_as_written(database(), lease.job_id)) leave(database(), lease, Status::pending);
    return held;
  });
}

std::int64_t Store::retry_failed() {
  return database().transaction([&] {
    Prepared statement(database(), R"(
      UPDATE jobs SET status = 'pending', attempts = 0, finished = NULL WHERE job_id = ?)");
    std::int64_t reopened = 0;
    for (const std::int64_t job_id :
         ids(database().sqlite(), "SELECT job_id FROM jobs WHERE status = 'failed'")) {
      if (!is_as_written(database(), job_id)) continue;
      statement.reset();
      statement.bind(1, job_id);
      reopened += statement.exec();
    }
    return reopened;
  });
}

bool Store::restart(std::int64_t job_id) {
  return database().transaction([&] {
    database().digests().must_match(job_id, Part::jobs);
    const auto change = [&](const char* sql) {
      SQLite::Statement statement(database().sqlite(), sql);
      statement.bind(1, job_id);
      return statement.exec();
    };
    if (change(R"(
          UPDATE jobs SET status = 'pending', attempts = 0, error = NULL, tau_reached = 0, collisions = 0,
                          finished = NULL, starts_over = 1, physics_version = NULL
          WHERE job_id = ? AND status NOT IN ('running', 'lent'))") == 0)
      return false;
    change("DELETE FROM invariants WHERE job_id = ?");
    return true;
  });
}

}  // namespace haff::schema
