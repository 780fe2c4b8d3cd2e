#include "schema/store/store.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <stdexcept>

#include "schema/database/database.hpp"
#include "schema/digests/checksum.hpp"
#include "schema/rows/sample_columns.hpp"
#include "schema/store/contradiction.hpp"
#include "schema/store/job_rows.hpp"
#include "schema/store/rows.hpp"

namespace haff::schema {

namespace {

const std::string now = "strftime('%Y-%m-%dT%H:%M:%fZ', 'now')";

void bind(SQLite::Statement& statement, const char* name, std::optional<double> value) {
  if (value)
    statement.bind(name, *value);
  else
    statement.bind(name);
}

// ---- planning ---------------------------------------------------------------------------------

std::optional<std::int64_t> id_of(SQLite::Database& sqlite, const Job& job) {
  SQLite::Statement statement(sqlite, "SELECT job_id FROM jobs WHERE identity = ?");
  statement.bind(1, identity(job));
  if (!statement.executeStep()) return std::nullopt;
  return integer(statement, "job_id");
}

// The job that a cooling job starts from; nothing for an equilibration.
std::optional<std::int64_t> equilibration_id(SQLite::Database& sqlite, const Job& job) {
  if (job.kind == Kind::equilibration) return std::nullopt;
  const Job start = equilibration_of(job);
  if (const auto id = id_of(sqlite, start)) return id;
  throw std::logic_error("a plan lacks the equilibration of its jobs: " + identity(start));
}

void insert(SQLite::Database& sqlite, const Planned& planned) {
  SQLite::Statement statement(
      sqlite,
      "INSERT INTO jobs (identity, kind, d, e, n, particles, seed, equilibrate, "
      "sample_every, effects, observables, profiles_every, fields_at, tau_max, "
      "checkpoint_every, "
      "equilibration_id, expected_cpu_seconds, created) "
      "VALUES (:identity, :kind, :d, :e, :n, :particles, :seed, :equilibrate, "
      ":sample_every, :effects, :observables, :profiles_every, :fields_at, :tau_max, "
      ":checkpoint_every, "
      ":equilibration_id, :expected_cpu_seconds, " +
          now + ")");
  const Job& job = planned.job;
  statement.bind(":identity", identity(job));
  statement.bind(":kind", std::string(name(job.kind)));
  statement.bind(":d", job.d);
  bind(statement, ":e", job.e);
  statement.bind(":n", job.n);
  statement.bind(":particles", job.particles);
  statement.bind(":seed", static_cast<std::int64_t>(job.seed));
  statement.bind(":equilibrate", job.equilibrate);
  statement.bind(":sample_every", job.sample_every);
  statement.bind(":effects", job.effects.text());
  statement.bind(":observables", observables_text(job.observables));
  bind(statement, ":profiles_every", job.profiles_every);
  if (!job.fields_at.empty()) statement.bind(":fields_at", fields_at_text(job.fields_at));
  statement.bind(":tau_max", planned.tau_max);
  statement.bind(":checkpoint_every", planned.checkpoint_every);
  if (const auto id = equilibration_id(sqlite, job)) statement.bind(":equilibration_id", *id);
  bind(statement, ":expected_cpu_seconds", planned.expected_cpu_seconds);
  statement.exec();
}

void extend(SQLite::Database& sqlite, const Planned& planned) {
  SQLite::Statement statement(sqlite, R"(
    UPDATE jobs SET tau_max = :tau_max, checkpoint_every = :checkpoint_every,
                    expected_cpu_seconds = coalesce(:expected_cpu_seconds, expected_cpu_seconds),
                    finished = iif(status = 'done', NULL, finished),
                    status = iif(status = 'done', 'pending', status)
    WHERE identity = :identity)");
  statement.bind(":identity", identity(planned.job));
  statement.bind(":tau_max", planned.tau_max);
  statement.bind(":checkpoint_every", planned.checkpoint_every);
  bind(statement, ":expected_cpu_seconds", planned.expected_cpu_seconds);
  statement.exec();
}

Outcome add(Database& database, const Planned& planned) {
  SQLite::Database& sqlite = database.sqlite();
  const Outcome what = outcome(sqlite, planned);
  if (what == Outcome::added) insert(sqlite, planned);
  if (what == Outcome::extended) {
    database.digests().must_match(id_of(sqlite, planned.job).value(), Part::jobs);
    extend(sqlite, planned);
  }
  return what;
}

// ---- working ----------------------------------------------------------------------------------

bool holds(SQLite::Database& sqlite, const Lease& lease) {
  SQLite::Statement statement(
      sqlite, "SELECT 1 FROM jobs WHERE job_id = ? AND lease = ? AND status = 'running'");
  statement.bind(1, lease.job_id);
  statement.bind(2, lease.token);
  return statement.executeStep();
}

void must_hold(Database& database, const Lease& lease) {
  if (!holds(database.sqlite(), lease))
    throw LeaseLost(database.path().string() + ": job " + std::to_string(lease.job_id) +
                    " has passed to another worker; what this one did since its last commit is "
                    "dropped");
  database.digests().must_match(lease.job_id, Part::jobs);
}

void report(SQLite::Database& sqlite, const Lease& lease, const Progress& progress) {
  SQLite::Statement statement(sqlite,
                              "UPDATE jobs SET tau = ?, collisions = ?, cpu_seconds = ?, "
                              "renewed = iif(status = 'running', " +
                                  now + ", NULL) WHERE job_id = ?");
  statement.bind(1, progress.tau);
  statement.bind(2, progress.collisions);
  statement.bind(3, progress.cpu_seconds);
  statement.bind(4, lease.job_id);
  statement.exec();
}

// A job that has come to its end from its start, without a new state on the way: the damaged one
// has served its time.
void drop_unused_state(SQLite::Database& sqlite, const Lease& lease) {
  for (const char* sql : {"DELETE FROM checkpoint_chunks WHERE job_id IN "
                          "(SELECT job_id FROM jobs WHERE job_id = ? AND starts_over)",
                          "DELETE FROM checkpoints WHERE job_id IN "
                          "(SELECT job_id FROM jobs WHERE job_id = ? AND starts_over)",
                          "UPDATE jobs SET starts_over = 0 WHERE job_id = ?"}) {
    SQLite::Statement statement(sqlite, sql);
    statement.bind(1, lease.job_id);
    statement.exec();
  }
}

// The end of a lease. The job is where its last checkpoint is.
void leave(SQLite::Database& sqlite, const Lease& lease, Status status) {
  SQLite::Statement statement(sqlite, R"(
    UPDATE jobs SET
      status = :status,
      owner_boot_id = NULL, owner_pid = NULL, owner_started = NULL, renewed = NULL,
      tau = iif(starts_over, 0,
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

// The row of this job is not as it was written. It is worked on no further, and stays known as
// wrong: what it said may be seen, and `campaign verify --repair` puts it right.
void condemn(Database& database, std::int64_t job_id, const std::string& why) {
  SQLite::Statement statement(database.sqlite(), R"(
    UPDATE jobs SET status = 'failed', error = ?, owner_boot_id = NULL, owner_pid = NULL,
                    owner_started = NULL, renewed = NULL
    WHERE job_id = ?)");
  statement.bind(1, printable(why));
  statement.bind(2, job_id);
  statement.exec();
  database.digests().leave_alone(job_id);
}

// Whether the job's row is as it was written. If not, it is condemned.
bool is_as_written(Database& database, std::int64_t job_id) {
  try {
    database.digests().must_match(job_id, Part::jobs);
    return true;
  } catch (const BadValue& bad) {
    condemn(database, job_id, bad.what());
    return false;
  }
}

// For the end of a lease: false if the row of its job had to be condemned.
bool is_held(Database& database, const Lease& lease) {
  if (!holds(database.sqlite(), lease)) must_hold(database, lease);
  return is_as_written(database, lease.job_id);
}

std::vector<std::int64_t> ids(SQLite::Database& sqlite, const char* sql) {
  SQLite::Statement statement(sqlite, sql);
  std::vector<std::int64_t> found;
  while (statement.executeStep()) found.push_back(statement.getColumn(0).getInt64());
  return found;
}

void must_be_finite(const Lease& lease, const Sample& sample) {
  bool sound = std::isfinite(sample.tau) && std::isfinite(sample.time);
  for (const SampleColumn& column : sample_columns)
    sound = sound && std::isfinite((sample.*column.value).value_or(0));
  if (!sound)
    throw Damage("job " + std::to_string(lease.job_id) + ": the sample at tau = " +
                 std::to_string(sample.tau) + " holds a value that is not finite");
}

// A sample that is there already is kept. What the trajectory alone decides must have come out
// the same; gamma_ratio may differ in its last digits between two machines' logarithms.
void must_agree(SQLite::Database& sqlite, const Lease& lease, const Sample& again) {
  SQLite::Statement statement(sqlite, "SELECT * FROM samples WHERE job_id = ? AND tau = ?");
  statement.bind(1, lease.job_id);
  statement.bind(2, again.tau);
  statement.executeStep();
  const Sample stored = sample(statement);
  if (stored.time != again.time || stored.temperature != again.temperature)
    throw Damage("job " + std::to_string(lease.job_id) +
                 ": the sample at tau = " + std::to_string(again.tau) + " " + came_out_different +
                 "; one of the two computations was disturbed, or the program that made the first "
                 "has changed");
}

void insert(Database& database, const Lease& lease, const std::vector<Sample>& samples) {
  if (samples.empty()) return;
  const DigestedTable& table = database.digests().table(Part::samples);
  std::string names = "job_id, tau, time", places = "?, ?, ?";
  for (const SampleColumn& column : sample_columns) {
    names += std::string(", ") + column.name;
    places += ", ?";
  }
  SQLite::Statement statement(database.sqlite(),
                              "INSERT INTO samples (" + names + ") VALUES (" + places +
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
      must_agree(database.sqlite(), lease, sample);
  }
}

// Profiles that are there already are kept: the samples beside them say whether the gas is the
// same, and the last digits of a transform may differ between two libraries.
void insert(Database& database, const Lease& lease, const std::vector<Profile>& profiles) {
  if (profiles.empty()) return;
  const DigestedTable& table = database.digests().table(Part::profiles);
  SQLite::Statement statement(
      database.sqlite(),
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
  SQLite::Statement statement(
      database.sqlite(),
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

void replace(SQLite::Database& sqlite, const Lease& lease, const Checkpoint& checkpoint,
             std::uint64_t sum) {
  SQLite::Statement drop(sqlite, "DELETE FROM checkpoint_chunks WHERE job_id = ?");
  drop.bind(1, lease.job_id);
  drop.exec();

  SQLite::Statement header(
      sqlite,
      "INSERT OR REPLACE INTO checkpoints (job_id, tau, collisions, bytes, checksum, created) "
      "VALUES (?, ?, ?, ?, ?, " +
          now + ")");
  header.bind(1, lease.job_id);
  header.bind(2, checkpoint.tau);
  header.bind(3, checkpoint.collisions);
  header.bind(4, static_cast<std::int64_t>(checkpoint.state.size()));
  header.bind(5, static_cast<std::int64_t>(sum));
  header.exec();

  SQLite::Statement insert(
      sqlite, "INSERT INTO checkpoint_chunks (job_id, position, bytes) VALUES (?, ?, ?)");
  const std::span<const std::byte> state(checkpoint.state);
  for (std::size_t begin = 0; begin < state.size(); begin += chunk_bytes) {
    const auto chunk = state.subspan(begin, std::min(chunk_bytes, state.size() - begin));
    insert.reset();
    insert.bind(1, lease.job_id);
    insert.bind(2, static_cast<std::int64_t>(begin / chunk_bytes));
    insert.bindNoCopy(3, chunk.data(), static_cast<int>(chunk.size()));
    insert.exec();
  }

  SQLite::Statement progress(sqlite,
                             "UPDATE jobs SET attempts = 0, starts_over = 0 WHERE job_id = ?");
  progress.bind(1, lease.job_id);
  progress.exec();
}

void replace(SQLite::Database& sqlite, const Lease& lease, const Invariants& invariants) {
  SQLite::Statement statement(sqlite, R"(
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

void note_physics(SQLite::Database& sqlite, const Lease& lease, int physics_version) {
  SQLite::Statement statement(sqlite, "UPDATE jobs SET physics_version = ? WHERE job_id = ?");
  statement.bind(1, physics_version);
  statement.bind(2, lease.job_id);
  statement.exec();
}

// A commit, with its checksum already computed, so that no process waits for the write lock
// meanwhile.
class Entry {
 public:
  Entry(const Lease& lease, const Commit& commit) : lease_(lease), commit_(commit) {
    if (commit.checkpoint) sum_ = checksum(commit.checkpoint->state);
  }

  void write(Database& database) const {
    must_hold(database, lease_);
    insert(database, lease_, commit_.samples);
    insert(database, lease_, commit_.profiles);
    insert(database, lease_, commit_.fields);
    if (commit_.checkpoint) replace(database.sqlite(), lease_, *commit_.checkpoint, sum_);
    if (commit_.invariants) replace(database.sqlite(), lease_, *commit_.invariants);
    if (commit_.physics_version) note_physics(database.sqlite(), lease_, *commit_.physics_version);
    report(database.sqlite(), lease_, commit_.progress);
  }

 private:
  const Lease& lease_;
  const Commit& commit_;
  std::uint64_t sum_ = 0;
};

void replace(SQLite::Database& sqlite, const Lease& lease, const Results& results) {
  SQLite::Statement statement(sqlite,
                              "INSERT OR REPLACE INTO results (job_id, tau_c, time_c) "
                              "VALUES (:job_id, :tau_c, :time_c)");
  statement.bind(":job_id", lease.job_id);
  bind(statement, ":tau_c", results.tau_c);
  bind(statement, ":time_c", results.time_c);
  statement.exec();
}

}  // namespace

Store Store::create(const std::filesystem::path& path) {
  return Store(std::make_unique<Database>(path, Access::create));
}

Store Store::open(const std::filesystem::path& path) {
  return Store(std::make_unique<Database>(path, Access::write));
}

Store Store::in_memory() {
  return Store(Database::in_memory());
}

int Store::upgrade(const std::filesystem::path& path, const std::vector<Lease>& dead) {
  Database database(path, Access::upgrade);
  return database.guarded([&] {
    SQLite::Database& sqlite = database.sqlite();
    const int before = version_of(sqlite);
    database.bring_forward([&] {
      for (const Lease& lease : dead)
        if (holds(sqlite, lease) && is_as_written(database, lease.job_id))
          leave(sqlite, lease, Status::pending);
      SQLite::Statement running(sqlite, "SELECT * FROM jobs WHERE status = 'running'");
      if (running.executeStep())
        throw StoreError(path.string() + ": job " + std::to_string(integer(running, "job_id")) +
                         " is being run by process " + std::to_string(owner(running).pid) + " on " +
                         owner(running).host +
                         ", a program of the older version; upgrade when its run has ended");
    });
    return before;
  });
}

void Store::open_log() {
  database().open_log();
}

LogSize Store::copy_log() {
  return database().copy_log();
}

bool Store::close_log(std::chrono::milliseconds patience) {
  return database().close_log(patience);
}

std::optional<std::string> Store::displaced() const {
  return database().displaced();
}

void Store::abandon_log(const std::filesystem::path& kept_as) {
  database().abandon_log(kept_as);
}

std::vector<Outcome> Store::add(const std::vector<Planned>& plan) {
  return database().transaction([&] {
    std::vector<Outcome> outcomes(plan.size());
    for (const Kind kind : {Kind::equilibration, Kind::cooling})
      for (std::size_t i = 0; i < plan.size(); ++i)
        if (plan[i].job.kind == kind) outcomes[i] = schema::add(database(), plan[i]);
    return outcomes;
  });
}

void Store::add(const std::vector<Target>& targets) {
  database().transaction([&] {
    database().digests().must_match_table("targets");
    SQLite::Statement statement(database().sqlite(), R"(
      INSERT INTO targets (series, quantity, tau_from, tau_to, se, pilots)
      VALUES (:series, :quantity, :tau_from, :tau_to, :se, :pilots)
      ON CONFLICT DO UPDATE SET se = excluded.se)");
    for (const Target& target : targets) {
      statement.reset();
      statement.bind(":series", target.series);
      statement.bind(":quantity", target.quantity);
      statement.bind(":tau_from", target.tau_from);
      statement.bind(":tau_to", target.tau_to);
      statement.bind(":se", target.se);
      statement.bind(":pilots", seeds_text(target.pilots));
      statement.exec();
    }
  });
}

void Store::predict(const Target& target, const Prediction& prediction) {
  database().transaction([&] {
    database().digests().must_match_table("target_predictions");
    SQLite::Statement statement(database().sqlite(), R"(
      INSERT INTO target_predictions
        (series, quantity, tau_from, tau_to, se, realizations, cpu_seconds, created)
      VALUES (:series, :quantity, :tau_from, :tau_to, :se, :realizations, :cpu_seconds, )" +
                                                         now + ") ON CONFLICT DO NOTHING");
    statement.bind(":series", target.series);
    statement.bind(":quantity", target.quantity);
    statement.bind(":tau_from", target.tau_from);
    statement.bind(":tau_to", target.tau_to);
    statement.bind(":se", target.se);
    statement.bind(":realizations", static_cast<std::int64_t>(prediction.realizations));
    statement.bind(":cpu_seconds", prediction.cpu_seconds);
    statement.exec();
  });
}

void Store::wait_for_locks_while(bool (*may_wait)()) {
  database().wait_for_locks_while(may_wait);
}

std::optional<Claim> Store::claim(const Owner& owner, const std::string& code_version,
                                  const std::optional<Fit>& fit) {
  return database().transaction([&]() -> std::optional<Claim> {
    SQLite::Statement next(database().sqlite(), "SELECT jobs.job_id " +
                                                    std::string(from_claimable_jobs) + "AND " +
                                                    seconds_to_next_tau + R"( <= :seconds
        ORDER BY jobs.kind = 'equilibration' DESC,
                 coalesce(jobs.expected_cpu_seconds, 0) * (1 - jobs.tau / jobs.tau_max) DESC,
                 jobs.particles * (jobs.tau_max - jobs.tau) DESC,
                 jobs.job_id
        LIMIT 1)");
    next.bind(":seconds", fit ? fit->seconds : std::numeric_limits<double>::max());
    next.bind(":tau", fit ? fit->tau : 0);
    std::int64_t job_id = 0;
    do {
      next.reset();
      if (!next.executeStep()) return std::nullopt;
      job_id = next.getColumn(0).getInt64();
      next.reset();
    } while (!is_as_written(database(), job_id));

    SQLite::Statement statement(database().sqlite(), R"(
      UPDATE jobs SET status = 'running', lease = lease + 1, host = :host,
                      owner_boot_id = :boot_id, owner_pid = :pid, owner_started = :started,
                      code_version = :code_version, renewed = )" +
                                                         now + R"(,
                      started = coalesce(started, )" + now +
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
  });
}

void Store::progress(const Lease& lease, const Progress& progress) {
  database().transaction([&] {
    must_hold(database(), lease);
    report(database().sqlite(), lease, progress);
  });
}

void Store::commit(const Lease& lease, const Commit& commit) {
  const Entry entry(lease, commit);
  database().transaction([&] { entry.write(database()); });
}

Status Store::finish(const Lease& lease, const Commit& commit,
                     const std::optional<Results>& results, double tau_max) {
  const Entry entry(lease, commit);
  return database().transaction([&] {
    SQLite::Database& sqlite = database().sqlite();
    entry.write(database());
    if (results) replace(sqlite, lease, *results);

    SQLite::Statement row(sqlite, "SELECT tau_max FROM jobs WHERE job_id = ?");
    row.bind(1, lease.job_id);
    row.executeStep();
    const bool extended = real(row, "tau_max") > tau_max;
    const Status status = extended ? Status::pending : Status::done;
    drop_unused_state(sqlite, lease);
    leave(sqlite, lease, status);
    if (!extended) report(sqlite, lease, commit.progress);

    SQLite::Statement clear(sqlite, "UPDATE jobs SET error = NULL, attempts = 0 WHERE job_id = ?");
    clear.bind(1, lease.job_id);
    clear.exec();
    return status;
  });
}

Status Store::fail(const Lease& lease, const std::string& error, bool again) {
  return database().transaction([&] {
    if (!is_held(database(), lease)) return Status::failed;
    SQLite::Statement statement(database().sqlite(), R"(
      UPDATE jobs SET attempts = attempts + 1, error = :error WHERE job_id = :job_id
      RETURNING attempts)");
    statement.bind(":error", printable(error));
    statement.bind(":job_id", lease.job_id);
    statement.executeStep();
    const bool last = !again || integer(statement, "attempts") >= max_attempts;
    const Status status = last ? Status::failed : Status::pending;
    leave(database().sqlite(), lease, status);
    return status;
  });
}

void Store::collapse(const Lease& lease, const Commit& commit, const std::string& what) {
  const Entry entry(lease, commit);
  database().transaction([&] {
    SQLite::Database& sqlite = database().sqlite();
    entry.write(database());
    SQLite::Statement statement(sqlite, "UPDATE jobs SET error = ? WHERE job_id = ?");
    statement.bind(1, printable(what));
    statement.bind(2, lease.job_id);
    statement.exec();
    drop_unused_state(sqlite, lease);
    leave(sqlite, lease, Status::collapsed);
    report(sqlite, lease, commit.progress);
  });
}

void Store::release(const Lease& lease) {
  database().transaction([&] {
    if (is_held(database(), lease)) leave(database().sqlite(), lease, Status::pending);
  });
}

bool Store::reclaim(const Lease& lease) {
  return database().transaction([&] {
    const bool held = holds(database().sqlite(), lease);
    if (held && is_as_written(database(), lease.job_id))
      leave(database().sqlite(), lease, Status::pending);
    return held;
  });
}

std::int64_t Store::retry_failed() {
  return database().transaction([&] {
    SQLite::Statement statement(database().sqlite(), R"(
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
          UPDATE jobs SET status = 'pending', attempts = 0, error = NULL, tau = 0, collisions = 0,
                          finished = NULL, starts_over = 1, physics_version = NULL
          WHERE job_id = ? AND status NOT IN ('running', 'lent'))") == 0)
      return false;
    change("DELETE FROM invariants WHERE job_id = ?");
    return true;
  });
}

std::int64_t Store::replace_rows(std::int64_t job_id, Part part, const Reader& other,
                                 std::int64_t job_there) {
  return database().transaction([&] {
    const RowsOfJob ours{database(), job_id}, theirs{other.database(), job_there};
    std::set<std::string> rows;
    for (const Difference& difference : schema::differences(ours, theirs, part))
      if (!difference.is_in_last_digits) rows.insert(difference.row);
    const bool is_state = part == Part::checkpoints;
    if (is_state) drop_rows(ours, "checkpoint_chunks");
    drop_differing_rows(ours, theirs, part);
    add_rows(ours, theirs, name(part));
    if (is_state) add_rows(ours, theirs, "checkpoint_chunks");
    database().digests().changed(job_id, part);
    return static_cast<std::int64_t>(rows.size());
  });
}

void Store::digest_again(std::int64_t job_id, Part part) {
  database().transaction([&] {
    SQLite::Statement make(database().sqlite(),
                           "INSERT OR IGNORE INTO digests (job_id) VALUES (?)");
    make.bind(1, job_id);
    make.exec();
    database().digests().changed(job_id, part);
  });
}

void Store::digest_table_again(const std::string& table) {
  database().transaction([&] { database().digests().changed_table(table); });
}

std::int64_t Store::drop_rows_after(std::int64_t job_id, double tau) {
  return database().transaction([&] {
    const auto drop = [&](Part part) {
      SQLite::Statement statement(database().sqlite(), std::string("DELETE FROM ") + name(part) +
                                                           " WHERE job_id = ? AND tau > ?");
      statement.bind(1, job_id);
      statement.bind(2, tau);
      const std::int64_t dropped = statement.exec();
      database().digests().changed(job_id, part);
      return dropped;
    };
    const std::int64_t samples = drop(Part::samples);
    drop(Part::profiles);
    drop(Part::fields);
    drop_rows({database(), job_id}, name(Part::results));
    return samples;
  });
}

}  // namespace haff::schema
