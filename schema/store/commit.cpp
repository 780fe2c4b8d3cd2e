// SPDX-License-Identifier: GPL-3.0-or-later

// What a worker commits: rows, a state, results, and with them the end of its job.
#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "schema/database/database.hpp"
#include "schema/digests/checksum.hpp"
#include "schema/rows/sample_columns.hpp"
#include "schema/store/lease.hpp"
#include "schema/store/rows/bind.hpp"
#include "schema/store/rows/checked_rows.hpp"
#include "schema/store/rows/state_rows.hpp"
#include "schema/store/soundness/agreement.hpp"
#include "schema/store/store.hpp"

namespace haff::schema {

namespace {

void must_be_finite(const Lease& lease, const Sample& sample) {
  bool sound = std::isfinite(sample.tau) && std::isfinite(sample.time);
  for (const SampleColumn& column : sample_columns)
    sound = sound && std::isfinite((sample.*column.value).value_or(0));
  if (!sound)
    throw Damage("job " + std::to_string(lease.job_id) + ": the sample at tau = " +
                 std::to_string(sample.tau) + " holds a value that is not finite");
}

// Samples that are there already are kept.
void insert(Database& database, const Lease& lease, const std::vector<Sample>& samples) {
  if (samples.empty()) return;
  const DigestedTable& table = database.digests().table(Part::samples);
  std::string names = "job_id, tau, time", places = "?, ?, ?";
  for (const SampleColumn& column : sample_columns) {
    names += std::string(", ") + column.name;
    places += ", ?";
  }
  Prepared statement(database, "INSERT INTO samples (" + names + ") VALUES (" + places +
                                   ") ON CONFLICT DO NOTHING RETURNING " + table.columns());
  for (const Sample& sample : samples) {
    must_be_finite(lease, sample);
    statement.reset();
    statement.clearBindings();
    statement.bind(1, lease.job_id);
    statement.bind(2, sample.tau);
    statement.bind(3, sample.time);
    int place = 4;
    for (const SampleColumn& column : sample_columns) {
      if (const auto& value = sample.*column.value) statement.bind(place, *value);
      ++place;
    }
    if (statement.executeStep())
      database.digests().added(lease.job_id, Part::samples, table.digest(statement));
    else
      must_agree(database, lease.job_id, sample);
  }
}

// Profiles that are there already are kept: the samples beside them say whether the gas is the
// same, and the last digits of a transform may differ between two libraries.
void insert(Database& database, const Lease& lease, const std::vector<Profile>& profiles) {
  if (profiles.empty()) return;
  const DigestedTable& table = database.digests().table(Part::profiles);
  Prepared statement(database,
                     "INSERT INTO profiles (job_id, name, tau, x, value) VALUES (?, ?, ?, ?, ?) "
                     "ON CONFLICT DO NOTHING RETURNING " +
                         table.columns());
  for (const Profile& profile : profiles) {
    if (profile.x.size() != profile.value.size())
      throw std::logic_error("the profile " + profile.name + " has not as many values as places");
    for (std::size_t i = 0; i < profile.x.size(); ++i) {
      if (!std::isfinite(profile.value[i]))
        throw Damage("job " + std::to_string(lease.job_id) + ": the profile " + profile.name +
                     " at tau = " + std::to_string(profile.tau) +
                     " holds a value that is not finite");
      statement.reset();
      statement.bind(1, lease.job_id);
      statement.bind(2, profile.name);
      statement.bind(3, profile.tau);
      statement.bind(4, profile.x[i]);
      statement.bind(5, profile.value[i]);
      if (statement.executeStep())
        database.digests().added(lease.job_id, Part::profiles, table.digest(statement));
    }
  }
}

void insert(Database& database, const Lease& lease, const std::vector<Field>& fields) {
  static_assert(std::endian::native == std::endian::little, "the store holds little-endian reals");
  if (fields.empty()) return;
  const DigestedTable& table = database.digests().table(Part::fields);
  Prepared statement(database,
                     "INSERT INTO fields (job_id, name, tau, cells, components, box, data) "
                     "VALUES (?, ?, ?, ?, ?, ?, ?) ON CONFLICT DO NOTHING RETURNING " +
                         table.columns());
  for (const Field& field : fields) {
    statement.reset();
    statement.bind(1, lease.job_id);
    statement.bind(2, field.name);
    statement.bind(3, field.tau);
    statement.bind(4, field.cells);
    statement.bind(5, field.components);
    statement.bind(6, field.box);
    statement.bindNoCopy(7, field.values.data(),
                         static_cast<int>(field.values.size() * sizeof(double)));
    if (statement.executeStep())
      database.digests().added(lease.job_id, Part::fields, table.digest(statement));
  }
}

// A snapshot that is there already must be this one, in every bit.
void insert(Database& database, const Lease& lease, const Snapshot& snapshot, std::uint64_t sum) {
  const DigestedTable& table = database.digests().table(Part::snapshots);
  Prepared header(database,
                  "INSERT INTO snapshots (job_id, time, tau, collisions, bytes, checksum) "
                  "VALUES (?, ?, ?, ?, ?, ?) ON CONFLICT DO NOTHING RETURNING " +
                      table.columns());
  header.bind(1, lease.job_id);
  header.bind(2, snapshot.time);
  header.bind(3, snapshot.tau);
  header.bind(4, snapshot.collisions);
  header.bind(5, static_cast<std::int64_t>(snapshot.state.size()));
  header.bind(6, static_cast<std::int64_t>(sum));
  if (!header.executeStep()) return must_agree(database, lease.job_id, snapshot, sum);
  database.digests().added(lease.job_id, Part::snapshots, table.digest(header));
  header.reset();

  Prepared insert(
      database, "INSERT INTO snapshot_chunks (job_id, time, position, bytes) VALUES (?, ?, ?, ?)");
  insert.bind(1, lease.job_id);
  insert.bind(2, snapshot.time);
  insert_chunks(insert, 3, snapshot.state);
}

void replace(Database& database, const Lease& lease, const Checkpoint& checkpoint,
             std::uint64_t sum) {
  put_state(database, lease.job_id, checkpoint, sum);
  Prepared progress(database, "UPDATE jobs SET attempts = 0, starts_over = 0 WHERE job_id = ?");
  progress.bind(1, lease.job_id);
  progress.exec();
}

void replace(Database& database, const Lease& lease, const Invariants& invariants) {
  Prepared statement(database, R"(
    INSERT OR REPLACE INTO invariants
      (job_id, largest_overlap, past_events, unresolved_collisions, energy_mismatch,
       momentum_removed)
    VALUES (:job_id, :largest_overlap, :past_events, :unresolved_collisions, :energy_mismatch,
            :momentum_removed))");
  statement.bind(":job_id", lease.job_id);
  statement.bind(":largest_overlap", invariants.largest_overlap);
  statement.bind(":past_events", invariants.past_events);
  statement.bind(":unresolved_collisions", invariants.unresolved_collisions);
  statement.bind(":energy_mismatch", invariants.energy_mismatch);
  statement.bind(":momentum_removed", invariants.momentum_removed);
  statement.exec();
}

void note_physics(Database& database, const Lease& lease, int physics_version) {
  Prepared statement(database, "UPDATE jobs SET physics_version = ? WHERE job_id = ?");
  statement.bind(1, physics_version);
  statement.bind(2, lease.job_id);
  statement.exec();
}

// A commit with its checksums, which are computed before the write lock is taken, so that no
// process waits for them.
class Entry {
 public:
  Entry(const Lease& lease, const Commit& commit) : lease_(lease), commit_(commit) {
    if (commit.checkpoint) sum_ = checksum(commit.checkpoint->state);
    sums_.reserve(commit.snapshots.size());
    for (const Snapshot& snapshot : commit.snapshots) sums_.push_back(checksum(snapshot.state));
  }

  void write(Database& database) const {
    must_hold(database, lease_);
    insert(database, lease_, commit_.samples);
    insert(database, lease_, commit_.profiles);
    insert(database, lease_, commit_.fields);
    for (std::size_t k = 0; k < sums_.size(); ++k)
      insert(database, lease_, commit_.snapshots[k], sums_[k]);
    if (commit_.checkpoint) replace(database, lease_, *commit_.checkpoint, sum_);
    if (commit_.invariants) replace(database, lease_, *commit_.invariants);
    if (commit_.physics_version) note_physics(database, lease_, *commit_.physics_version);
    note_progress(database, lease_, commit_.progress);
  }

 private:
  const Lease& lease_;
  const Commit& commit_;
  std::uint64_t sum_ = 0;            // of the state
  std::vector<std::uint64_t> sums_;  // of the snapshots
};

void replace(Database& database, const Lease& lease, const Results& results) {
  Prepared statement(database,
                     "INSERT OR REPLACE INTO results (job_id, tau_c, time_c) "
                     "VALUES (:job_id, :tau_c, :time_c)");
  statement.bind(":job_id", lease.job_id);
  bind_optional(statement, ":tau_c", results.tau_c);
  bind_optional(statement, ":time_c", results.time_c);
  statement.exec();
}

// A job that began at its start, because its state was damaged, and came to its end without a new
// state on the way: the damaged one is needed no more.
void drop_unused_state(Database& database, const Lease& lease) {
  for (const char* sql : {"DELETE FROM checkpoint_chunks WHERE job_id IN "
                          "(SELECT job_id FROM jobs WHERE job_id = ? AND starts_over)",
                          "DELETE FROM checkpoints WHERE job_id IN "
                          "(SELECT job_id FROM jobs WHERE job_id = ? AND starts_over)",
                          "UPDATE jobs SET starts_over = 0 WHERE job_id = ?"}) {
    Prepared statement(database, sql);
    statement.bind(1, lease.job_id);
    statement.exec();
  }
}

}  // namespace

void Store::commit(const Lease& lease, const Commit& commit) {
  const Entry entry(lease, commit);
  database().transaction([&] { entry.write(database()); });
}

Status Store::finish(const Lease& lease, const Commit& commit,
                     const std::optional<Results>& results, double tau_max) {
  const Entry entry(lease, commit);
  return database().transaction([&] {
    entry.write(database());
    must_agree_with_same_physics(database(), lease.job_id);
    if (results) replace(database(), lease, *results);

    Prepared row(database(), "SELECT tau_max FROM jobs WHERE job_id = ?");
    row.bind(1, lease.job_id);
    row.executeStep();
    const bool extended = real(row, "tau_max") > tau_max;
    const Status status = extended ? Status::pending : Status::done;
    drop_unused_state(database(), lease);
    leave(database(), lease, status);
    if (!extended) note_progress(database(), lease, commit.progress);

    Prepared clear(database(), "UPDATE jobs SET error = NULL, attempts = 0 WHERE job_id = ?");
    clear.bind(1, lease.job_id);
    clear.exec();
    return status;
  });
}

void Store::collapse(const Lease& lease, const Commit& commit, const std::string& what) {
  const Entry entry(lease, commit);
  database().transaction([&] {
    entry.write(database());
    must_agree_with_same_physics(database(), lease.job_id);
    Prepared statement(database(), "UPDATE jobs SET error = ? WHERE job_id = ?");
    statement.bind(1, printable(what));
    statement.bind(2, lease.job_id);
    statement.exec();
    drop_unused_state(database(), lease);
    leave(database(), lease, Status::collapsed);
    note_progress(database(), lease, commit.progress);
  });
}

}  // namespace haff::schema
