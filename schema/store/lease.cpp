// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/store/lease.hpp"

#include "schema/store/rows/bind.hpp"

namespace haff::schema {

namespace {

// No process works on this job any more. Its row can still be read, and stays known as wrong.
void condemn(Database& database, std::int64_t job_id, const std::string& why) {
  Prepared statement(database, R"(
    UPDATE jobs SET status = 'failed', error = ?, owner_boot_id = NULL, owner_pid = NULL,
                    owner_started = NULL, renewed = NULL
    WHERE job_id = ?)");
  statement.bind(1, printable(why));
  statement.bind(2, job_id);
  statement.exec();
  database.digests().leave_alone(job_id);
}

}  // namespace

bool holds(Database& database, const Lease& lease) {
  Prepared statement(database,
                     "SELECT 1 FROM jobs WHERE job_id = ? AND lease = ? AND status = 'running'");
  statement.bind(1, lease.job_id);
  statement.bind(2, lease.token);
  return statement.executeStep();
}

void must_hold(Database& database, const Lease& lease) {
  if (!holds(database, lease))
    throw LeaseLost(database.path().string() + ": job " + std::to_string(lease.job_id) +
                    " has passed to another worker; what this one did since its last commit is "
                    "dropped");
  database.digests().must_match(lease.job_id, Part::jobs);
}

void note_progress(Database& database, const Lease& lease, const Progress& progress) {
  Prepared statement(database,
                     "UPDATE jobs SET tau_reached = ?, collisions = ?, cpu_seconds = ?, "
                     "renewed = iif(status = 'running', " +
                         now + ", NULL) WHERE job_id = ?");
  statement.bind(1, progress.tau);
  statement.bind(2, progress.collisions);
  statement.bind(3, progress.cpu_seconds);
  statement.bind(4, lease.job_id);
  statement.exec();
}

void leave(Database& database, const Lease& lease, Status status) {
  Prepared statement(database, R"(
    UPDATE jobs SET
      status = :status,
      owner_boot_id = NULL, owner_pid = NULL, owner_started = NULL, renewed = NULL,
      tau_reached = iif(starts_over, 0,
                        coalesce((SELECT tau FROM checkpoints WHERE job_id = :job_id), 0)),
      collisions = iif(starts_over, 0,
                       coalesce((SELECT collisions FROM checkpoints WHERE job_id = :job_id), 0)),
      finished = iif(:status = 'pending', NULL, )" +
                                   now + R"()
    WHERE job_id = :job_id)");
  statement.bind(":status", std::string(name(status)));
  statement.bind(":job_id", lease.job_id);
  statement.exec();
}

bool is_as_written(Database& database, std::int64_t job_id) {
  try {
    database.digests().must_match(job_id, Part::jobs);
    return true;
  } catch (const BadValue& bad) {
    condemn(database, job_id, bad.what());
    return false;
  }
}

bool is_held(Database& database, const Lease& lease) {
  if (!holds(database, lease)) must_hold(database, lease);
  return is_as_written(database, lease.job_id);
}

}  // namespace haff::schema
