// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/store/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "schema/database/backup.hpp"
#include "schema/database/database.hpp"
#include "schema/digests/checksum.hpp"
#include "schema/store/planning/claiming.hpp"
#include "schema/store/rows/checked_rows.hpp"
#include "schema/store/rows/job_rows.hpp"

namespace haff::schema {

namespace {

// Most of what is read comes from this table: the message says which row is wrong.
JobRow row_of_job(const SQLite::Statement& row) {
  try {
    return job_row(row);
  } catch (const BadValue& bad) {
    throw BadValue("job " + std::to_string(row.getColumn("job_id").getInt64()) + ": " + bad.what());
  }
}

// A state in pieces: those of a job, or of one of its snapshots.
struct Chunks {
  const char* table = nullptr;
  std::int64_t job_id = 0;
  std::optional<double> time = {};
};

// The sizes are checked before any chunk is read.
std::vector<std::byte> bytes_of(Database& database, const Chunks& which, std::int64_t size,
                                std::int64_t expected_checksum, const std::string& what) {
  const auto damaged = [&](const std::string& why) {
    return Damage(database.path().string() + ": " + what + " is damaged: " + why);
  };
  const std::string where = std::string(" FROM ") + which.table + " WHERE job_id = ?" +
                            (which.time ? " AND time = ?" : "");
  const auto bind_to = [&](SQLite::Statement& statement) {
    statement.bind(1, which.job_id);
    if (which.time) statement.bind(2, *which.time);
  };
  Prepared total(database,
                 "SELECT total(length(bytes)) AS size" + where + " AND typeof(bytes) = 'blob'");
  bind_to(total);
  total.executeStep();
  if (const double found = real(total, "size"); found != static_cast<double>(size))
    throw damaged("it holds " + std::to_string(static_cast<std::int64_t>(found)) + " bytes of " +
                  std::to_string(size));

  std::vector<std::byte> bytes;
  bytes.reserve(static_cast<std::size_t>(size));  // never two halves of it
  Prepared chunks(database, "SELECT position, bytes" + where + " ORDER BY position");
  bind_to(chunks);
  for (std::int64_t position = 0; chunks.executeStep(); ++position) {
    if (chunks.getColumn(0).getInt64() != position)
      throw damaged("chunk " + std::to_string(position) + " is missing");
    const auto chunk = chunks.getColumn(1);
    const auto* begin = static_cast<const std::byte*>(chunk.getBlob());
    bytes.insert(bytes.end(), begin, begin + chunk.getBytes());
  }
  if (static_cast<std::int64_t>(checksum(bytes)) != expected_checksum)
    throw damaged("its bytes do not add up to its checksum");
  return bytes;
}

}  // namespace

int newest_version() {
  return static_cast<int>(scripts().size());
}

Reader::Reader(const std::filesystem::path& path)
    : Reader(std::make_unique<Database>(path, Access::read)) {}
Reader::Reader(std::unique_ptr<Database> database) : database_(std::move(database)) {}
Reader::~Reader() = default;
Reader::Reader(Reader&&) noexcept = default;
Reader& Reader::operator=(Reader&&) noexcept = default;

const std::filesystem::path& Reader::path() const {
  return database_->path();
}

Summary summary_of(SQLite::Database& sqlite, const std::string& of_jobs) {
  Summary summary;
  for (const StatusEntry& entry : statuses) summary.jobs[entry.status] = 0;
  SQLite::Statement jobs(sqlite, R"(
    SELECT status, count(*) AS number, total(cpu_seconds) AS spent,
           total(expected_cpu_seconds) AS expected,
           total(expected_cpu_seconds * iif(status IN ('done', 'collapsed'), 1,
                                            min(1, tau_reached / tau_max))) AS reached,
           total(expected_cpu_seconds * max(0, 1 - tau_reached / tau_max))
             FILTER (WHERE status IN ('pending', 'running', 'lent')) AS remaining
    FROM )" + of_jobs + " GROUP BY status");
  while (jobs.executeStep()) {
    summary.jobs[status_named(text(jobs, "status"))] = integer(jobs, "number");
    summary.cpu_seconds += real(jobs, "spent");
    summary.expected_cpu_seconds += real(jobs, "expected");
    summary.reached_cpu_seconds += real(jobs, "reached");
    summary.remaining_cpu_seconds += real(jobs, "remaining");
  }
  SQLite::Statement pending(sqlite, R"(
    SELECT coalesce(equilibration.status, 'done') AS status_of_start, count(*) AS number
    FROM )" + of_jobs + R"( AS waiting
    LEFT JOIN jobs AS equilibration ON equilibration.job_id = waiting.equilibration_id
    WHERE waiting.status = 'pending' GROUP BY status_of_start)");
  while (pending.executeStep()) {
    const Status start = status_named(text(pending, "status_of_start"));
    auto& count = start == Status::done                                  ? summary.claimable
                  : start == Status::lent                                ? summary.elsewhere
                  : start == Status::pending || start == Status::running ? summary.waiting
                                                                         : summary.blocked;
    count += integer(pending, "number");
  }
  return summary;
}

Summary Reader::summary() const {
  return database_->snapshot([&] { return summary_of(database_->sqlite(), "jobs"); });
}

std::map<Status, std::int64_t> Reader::job_counts() const {
  return database_->guarded([&] {
    std::map<Status, std::int64_t> counts;
    SQLite::Statement statement(database_->sqlite(),
                                "SELECT status, count(*) AS number FROM jobs GROUP BY status");
    while (statement.executeStep())
      counts[status_named(text(statement, "status"))] = integer(statement, "number");
    return counts;
  });
}

std::vector<std::int64_t> Reader::job_ids() const {
  return database_->guarded([&] {
    SQLite::Statement statement(database_->sqlite(), "SELECT job_id FROM jobs ORDER BY job_id");
    std::vector<std::int64_t> ids;
    while (statement.executeStep()) ids.push_back(integer(statement, "job_id"));
    return ids;
  });
}

std::vector<JobRow> Reader::jobs() const {
  return database_->guarded([&] {
    SQLite::Statement statement(database_->sqlite(), R"(
      SELECT * FROM jobs
      ORDER BY kind DESC, d, n, particles, e, start, equilibrate, sample_every, effects,
               observables, profiles_every, fields_at, sample_at, snapshots_at, seed)");
    std::vector<JobRow> rows;
    while (statement.executeStep()) rows.push_back(row_of_job(statement));
    return rows;
  });
}

JobRow Reader::job(std::int64_t job_id) const {
  return database_->guarded([&] {
    Prepared statement(*database_, "SELECT * FROM jobs WHERE job_id = ?");
    statement.bind(1, job_id);
    if (!statement.executeStep())
      throw NameError(path().string() + ": there is no job " + std::to_string(job_id));
    return row_of_job(statement);
  });
}

std::optional<std::int64_t> Reader::find(const Job& job) const {
  return database_->guarded([&]() -> std::optional<std::int64_t> {
    Prepared statement(*database_, "SELECT job_id FROM jobs WHERE identity = ?");
    statement.bind(1, identity(job));
    if (!statement.executeStep()) return std::nullopt;
    return integer(statement, "job_id");
  });
}

std::vector<RunningJob> Reader::running() const {
  return database_->guarded([&] {
    Prepared statement(*database_, "SELECT * FROM jobs WHERE status = 'running' ORDER BY job_id");
    std::vector<RunningJob> jobs;
    while (statement.executeStep())
      jobs.push_back({.lease = {integer(statement, "job_id"), integer(statement, "lease")},
                      .owner = owner(statement),
                      .job = job_of(statement),
                      .tau_max = real(statement, "tau_max"),
                      .progress = progress_of(statement),
                      .renewed = text(statement, "renewed")});
    return jobs;
  });
}

bool Reader::has_claimable(const std::optional<Fit>& fit) const {
  return database_->guarded([&] {
    Prepared statement(*database_, fmt::format("SELECT 1 {}AND {} <= :seconds LIMIT 1",
                                               from_claimable_jobs, seconds_to_next_tau));
    statement.bind(":seconds", fit ? fit->seconds : std::numeric_limits<double>::max());
    statement.bind(":tau", fit ? fit->tau : 0);
    return statement.executeStep();
  });
}

std::optional<double> Reader::least_seconds_to(double tau) const {
  return database_->guarded([&]() -> std::optional<double> {
    Prepared statement(*database_, fmt::format("SELECT min({}) AS seconds {}", seconds_to_next_tau,
                                               from_claimable_jobs));
    statement.bind(":tau", tau);
    if (!statement.executeStep()) return std::nullopt;
    return optional_real(statement, "seconds");
  });
}

std::int64_t Reader::change_counter() const {
  return database_->guarded([&] {
    Prepared row(*database_, "PRAGMA data_version");
    row.executeStep();
    return row.getColumn(0).getInt64();
  });
}

// The rows are read in the same snapshot.
void Reader::must_match(std::int64_t job_id, Part part) const {
  database_->digests().must_match(job_id, part);
}

std::vector<Sample> Reader::samples(std::int64_t job_id) const {
  return database_->snapshot([&] {
    must_match(job_id, Part::samples);
    return samples_unchecked(job_id);
  });
}

std::vector<Sample> Reader::samples_unchecked(std::int64_t job_id) const {
  return database_->guarded([&] {
    Prepared statement(*database_, "SELECT * FROM samples WHERE job_id = ? ORDER BY tau");
    statement.bind(1, job_id);
    std::vector<Sample> samples;
    while (statement.executeStep()) samples.push_back(sample(statement));
    return samples;
  });
}

std::optional<Sample> Reader::last_sample(std::int64_t job_id, double tau) const {
  return database_->guarded([&]() -> std::optional<Sample> {
    Prepared statement(
        *database_,
        "SELECT * FROM samples WHERE job_id = ? AND tau <= ? ORDER BY tau DESC LIMIT 1");
    statement.bind(1, job_id);
    statement.bind(2, tau);
    if (!statement.executeStep()) return std::nullopt;
    return sample(statement);
  });
}

std::vector<Profile> Reader::profiles(std::int64_t job_id, const std::string& name) const {
  return database_->snapshot([&] {
    must_match(job_id, Part::profiles);
    Prepared points(
        *database_,
        "SELECT tau, x, value FROM profiles WHERE job_id = ? AND name = ? ORDER BY tau, x");
    points.bind(1, job_id);
    points.bind(2, name);
    std::vector<Profile> profiles;
    while (points.executeStep()) {
      const double tau = not_negative(points, "tau");
      if (profiles.empty() || profiles.back().tau != tau)
        profiles.push_back({.name = name, .tau = tau});
      profiles.back().x.push_back(real(points, "x"));
      profiles.back().value.push_back(real(points, "value"));
    }
    return profiles;
  });
}

std::optional<Field> Reader::field(std::int64_t job_id, const std::string& name, double tau) const {
  return database_->snapshot([&]() -> std::optional<Field> {
    must_match(job_id, Part::fields);
    Prepared row(*database_,
                 "SELECT fields.*, d FROM fields JOIN jobs USING (job_id) "
                 "WHERE job_id = ? AND name = ? AND fields.tau = ?");
    row.bind(1, job_id);
    row.bind(2, name);
    row.bind(3, tau);
    if (!row.executeStep()) return std::nullopt;
    return field_of(row);
  });
}

std::vector<FieldName> Reader::fields(std::int64_t job_id) const {
  return database_->guarded([&] {
    Prepared row(*database_, "SELECT name, tau FROM fields WHERE job_id = ? ORDER BY name, tau");
    row.bind(1, job_id);
    std::vector<FieldName> names;
    while (row.executeStep()) names.push_back({text(row, "name"), not_negative(row, "tau")});
    return names;
  });
}

std::optional<Results> Reader::results(std::int64_t job_id) const {
  return database_->snapshot([&]() -> std::optional<Results> {
    must_match(job_id, Part::results);
    Prepared statement(*database_, "SELECT * FROM results WHERE job_id = ?");
    statement.bind(1, job_id);
    if (!statement.executeStep()) return std::nullopt;
    return Results{optional_real(statement, "tau_c"), optional_real(statement, "time_c")};
  });
}

std::optional<Invariants> Reader::invariants(std::int64_t job_id) const {
  return database_->snapshot([&]() -> std::optional<Invariants> {
    must_match(job_id, Part::invariants);
    Prepared row(*database_, "SELECT * FROM invariants WHERE job_id = ?");
    row.bind(1, job_id);
    if (!row.executeStep()) return std::nullopt;
    return Invariants{.largest_overlap = real(row, "largest_overlap"),
                      .past_events = integer(row, "past_events", 0),
                      .unresolved_collisions = integer(row, "unresolved_collisions", 0),
                      .energy_mismatch = not_negative(row, "energy_mismatch"),
                      .momentum_removed = not_negative(row, "momentum_removed")};
  });
}

DigestsOfJob Reader::digests(std::int64_t job_id) const {
  return database_->snapshot([&] {
    DigestsOfJob found;
    const bool has_digests = database_->digests().has(job_id);
    for (std::size_t k = 0; k < part_count; ++k) {
      const auto part = static_cast<Part>(k);
      if (!has_digests) {
        found.wrong.push_back(part);
        continue;
      }
      const auto written = database_->digests().stored(job_id, part);
      if (!written)
        found.without.push_back(part);
      else if (*written != database_->digests().present(job_id, part))
        found.wrong.push_back(part);
    }
    return found;
  });
}

std::vector<std::string> Reader::wrong_tables() const {
  return database_->snapshot([&] { return database_->digests().wrong_tables(); });
}

void Reader::must_match_digests(const std::vector<Part>& parts) const {
  database_->snapshot([&] {
    Prepared averaged(*database_,
                      "SELECT job_id FROM jobs WHERE kind = 'cooling' AND status = 'done' "
                      "ORDER BY job_id");
    while (averaged.executeStep()) {
      // A flipped bit of its e would take it into another mean.
      must_match(integer(averaged, "job_id"), Part::jobs);
      for (const Part part : parts) must_match(integer(averaged, "job_id"), part);
    }
  });
}

std::vector<Difference> Reader::differences(std::int64_t job_id, Part part, const Reader& other,
                                            std::int64_t job_there) const {
  return database_->snapshot([&] {
    return schema::differences({database(), job_id}, {other.database(), job_there}, part);
  });
}

std::vector<Target> Reader::targets() const {
  return database_->snapshot([&] {
    for (const char* table : {"targets", "target_predictions"})
      database_->digests().must_match_table(table);
    Prepared row(*database_,
                 "SELECT * FROM targets "
                 "LEFT JOIN target_predictions USING (series, quantity, tau_from, tau_to, se) "
                 "ORDER BY series, quantity, tau_from, tau_to");
    std::vector<Target> targets;
    while (row.executeStep()) {
      targets.push_back({.series = text(row, "series"),
                         .quantity = text(row, "quantity"),
                         .tau_from = not_negative(row, "tau_from"),
                         .tau_to = not_negative(row, "tau_to"),
                         .se = positive(row, "se"),
                         .pilots = pilots(row)});
      if (!row.isColumnNull("realizations"))
        targets.back().prediction = {.realizations = static_cast<std::size_t>(
                                         integer(row, "realizations", 0, largest_whole)),
                                     .cpu_seconds = not_negative(row, "cpu_seconds")};
    }
    return targets;
  });
}

double Reader::stored_tau(std::int64_t job_id) const {
  return database_->guarded([&] {
    Prepared statement(*database_, "SELECT tau FROM checkpoints WHERE job_id = ?");
    statement.bind(1, job_id);
    return statement.executeStep() ? real(statement, "tau") : 0.0;
  });
}

std::vector<CheckpointInfo> Reader::checkpoints() const {
  return database_->guarded([&] {
    Prepared statement(*database_, "SELECT * FROM checkpoints ORDER BY job_id");
    std::vector<CheckpointInfo> infos;
    while (statement.executeStep()) infos.push_back(checkpoint_info(statement));
    return infos;
  });
}

std::optional<Checkpoint> Reader::checkpoint(std::int64_t job_id) const {
  return database_->snapshot([&]() -> std::optional<Checkpoint> {
    Prepared header(*database_, "SELECT * FROM checkpoints WHERE job_id = ?");
    header.bind(1, job_id);
    if (!header.executeStep()) return std::nullopt;
    must_match(job_id, Part::checkpoints);
    const CheckpointInfo info = checkpoint_info(header);
    return Checkpoint{
        .tau = info.tau,
        .collisions = info.collisions,
        .state = bytes_of(*database_, {.table = "checkpoint_chunks", .job_id = job_id}, info.bytes,
                          integer(header, "checksum"),
                          "the checkpoint of job " + std::to_string(job_id))};
  });
}

std::vector<SnapshotInfo> Reader::snapshots(std::int64_t job_id) const {
  return database_->snapshot([&] {
    must_match(job_id, Part::snapshots);
    Prepared row(*database_, "SELECT * FROM snapshots WHERE job_id = ? ORDER BY time");
    row.bind(1, job_id);
    std::vector<SnapshotInfo> infos;
    while (row.executeStep()) infos.push_back(snapshot_info(row));
    return infos;
  });
}

std::optional<Snapshot> Reader::snapshot(std::int64_t job_id, double time) const {
  return database_->snapshot([&]() -> std::optional<Snapshot> {
    must_match(job_id, Part::snapshots);
    Prepared header(*database_, "SELECT * FROM snapshots WHERE job_id = ? AND time = ?");
    header.bind(1, job_id);
    header.bind(2, time);
    if (!header.executeStep()) return std::nullopt;
    const SnapshotInfo info = snapshot_info(header);
    return Snapshot{
        .tau = info.tau,
        .time = info.time,
        .collisions = info.collisions,
        .state = bytes_of(*database_, {.table = "snapshot_chunks", .job_id = job_id, .time = time},
                          info.bytes, integer(header, "checksum"),
                          "the snapshot of job " + std::to_string(job_id) +
                              " at tau = " + std::to_string(info.tau))};
  });
}

std::uintmax_t Reader::back_up(const std::filesystem::path& to) const {
  return schema::back_up(*database_, to);
}

bool Reader::lacks_log() const {
  return database_->lacks_log();
}

Outcome outcome(SQLite::Database& sqlite, const Planned& planned) {
  SQLite::Statement statement(sqlite, "SELECT tau_max, status FROM jobs WHERE identity = ?");
  statement.bind(1, identity(planned.job));
  if (!statement.executeStep()) return Outcome::added;
  const bool longer = planned.tau_max > real(statement, "tau_max");
  const bool can_go_on = text(statement, "status") != name(Status::collapsed);
  return longer && can_go_on ? Outcome::extended : Outcome::unchanged;
}

std::vector<Outcome> Reader::preview(const std::vector<Planned>& plan) const {
  return database_->snapshot([&] {
    std::vector<Outcome> outcomes;
    outcomes.reserve(plan.size());
    for (const Planned& planned : plan) outcomes.push_back(outcome(database_->sqlite(), planned));
    return outcomes;
  });
}

Query Reader::query(const std::string& sql) const {
  return {*database_, sql};
}

Faults Reader::faults() const {
  return faults_of(*database_);
}

}  // namespace haff::schema
