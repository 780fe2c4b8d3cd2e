// SPDX-License-Identifier: GPL-3.0-or-later

// What a plan adds to the store: jobs, targets, and what targets are expected to take.
#include <stdexcept>

#include "schema/database/database.hpp"
#include "schema/digests/checksum.hpp"
#include "schema/store/planning/claiming.hpp"
#include "schema/store/rows/bind.hpp"
#include "schema/store/rows/checked_rows.hpp"
#include "schema/store/rows/state_rows.hpp"
#include "schema/store/store.hpp"

namespace haff::schema {

namespace {

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
      "sample_every, sample_at, effects, observables, profiles_every, fields_at, snapshots_at, "
      "start, tau_max, checkpoint_every, "
      "equilibration_id, expected_cpu_seconds, created) "
      "VALUES (:identity, :kind, :d, :e, :n, :particles, :seed, :equilibrate, "
      ":sample_every, :sample_at, :effects, :observables, :profiles_every, :fields_at, "
      ":snapshots_at, :start, :tau_max, :checkpoint_every, "
      ":equilibration_id, :expected_cpu_seconds, " +
          now + ")");
  const Job& job = planned.job;
  statement.bind(":identity", identity(job));
  statement.bind(":kind", std::string(name(job.kind)));
  statement.bind(":d", job.d);
  bind_optional(statement, ":e", job.e);
  statement.bind(":n", job.n);
  statement.bind(":particles", job.particles);
  statement.bind(":seed", static_cast<std::int64_t>(job.seed));
  statement.bind(":equilibrate", job.equilibrate);
  statement.bind(":sample_every", job.sample_every);
  statement.bind(":effects", job.effects.text());
  statement.bind(":observables", observables_text(job.observables));
  bind_optional(statement, ":profiles_every", job.profiles_every);
  if (!job.fields_at.empty()) statement.bind(":fields_at", fields_at_text(job.fields_at));
  if (!job.sample_at.empty()) statement.bind(":sample_at", schedule_text(job.sample_at));
  if (!job.snapshots_at.empty()) statement.bind(":snapshots_at", schedule_text(job.snapshots_at));
  if (!job.start.is_uniform()) statement.bind(":start", start_text(job.start));
  statement.bind(":tau_max", planned.tau_max);
  statement.bind(":checkpoint_every", planned.checkpoint_every);
  if (const auto id = equilibration_id(sqlite, job)) statement.bind(":equilibration_id", *id);
  bind_optional(statement, ":expected_cpu_seconds", planned.expected_cpu_seconds);
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
  bind_optional(statement, ":expected_cpu_seconds", planned.expected_cpu_seconds);
  statement.exec();
}

// The equilibration of a start from a file has nothing to do: it holds the state. Planned again, it
// has it again, if that was damaged meanwhile.
void give_state(Database& database, const Planned& planned, bool is_new) {
  SQLite::Database& sqlite = database.sqlite();
  const std::int64_t job_id = id_of(sqlite, planned.job).value();
  if (!is_new) database.digests().must_match(job_id, Part::jobs);
  SQLite::Statement done(sqlite,
                         "UPDATE jobs SET status = 'done', starts_over = 0, attempts = 0, "
                         "error = NULL, finished = " +
                             now + " WHERE job_id = ? AND status IN ('pending', 'failed', 'done')");
  done.bind(1, job_id);
  if (done.exec() == 0) return;  // a worker or a shard has it
  put_state(database, job_id, *planned.given_state, checksum(planned.given_state->state));
}

}  // namespace

Outcome add_or_extend(Database& database, const Planned& planned) {
  SQLite::Database& sqlite = database.sqlite();
  const Outcome what = outcome(sqlite, planned);
  if (what == Outcome::added) insert(sqlite, planned);
  if (what == Outcome::extended) {
    database.digests().must_match(id_of(sqlite, planned.job).value(), Part::jobs);
    extend(sqlite, planned);
  }
  if (planned.given_state) give_state(database, planned, what == Outcome::added);
  return what;
}

std::vector<Outcome> Store::add(const std::vector<Planned>& plan) {
  return database().transaction([&] {
    std::vector<Outcome> outcomes(plan.size());
    for (const Kind kind : {Kind::equilibration, Kind::cooling})
      for (std::size_t i = 0; i < plan.size(); ++i)
        if (plan[i].job.kind == kind) outcomes[i] = add_or_extend(database(), plan[i]);
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

void Store::predict(const Target& target, const CostPrediction& prediction) {
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

}  // namespace haff::schema
