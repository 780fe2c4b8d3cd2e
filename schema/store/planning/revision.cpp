// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/store/planning/revision.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "schema/database/database.hpp"
#include "schema/store/planning/claiming.hpp"
#include "schema/store/rows/job_rows.hpp"

namespace haff::schema {

namespace {

constexpr std::chrono::milliseconds patience{1000};  // with others that use the store

// Where a job is stored.
struct Stored {
  std::int64_t samples = 0;
  std::int64_t bytes = 0;  // of its state
  double tau = 0;          // of its last sample or its state
  bool has_state = false;  // from which it can go on
};

// A store's jobs with what is stored of each.
class Inventory {
 public:
  explicit Inventory(const Reader& store) : store_(store) {
    for (JobRow& row : store.jobs()) jobs_.emplace(row.job_id, std::move(row));
    for (const CheckpointInfo& info : store.checkpoints()) states_.emplace(info.job_id, info);
    for (const RunningJob& job : store.running()) owners_.emplace(job.lease.job_id, job.owner);
    for (const auto& [id, row] : jobs_)
      if (row.equilibration_id) users_[*row.equilibration_id].insert(id);
  }

  const std::map<std::int64_t, JobRow>& jobs() const { return jobs_; }
  const JobRow& job(std::int64_t job_id) const { return jobs_.at(job_id); }
  std::set<std::int64_t> users(std::int64_t equilibration) const {
    const auto found = users_.find(equilibration);
    return found == users_.end() ? std::set<std::int64_t>() : found->second;
  }

  Stored stored(std::int64_t job_id) const {
    Stored found;
    Query rows = store_.query(
        fmt::format("SELECT count(*), max(tau) FROM samples WHERE job_id = {}", job_id));
    const Row row = rows.next().value();
    found.samples = std::get<std::int64_t>(row[0]);
    if (const auto* tau = std::get_if<double>(&row[1])) found.tau = *tau;
    if (const auto state = states_.find(job_id); state != states_.end()) {
      found.bytes = state->second.bytes;
      found.has_state = !job(job_id).starts_over;
      if (found.has_state) found.tau = std::max(found.tau, state->second.tau);
    }
    return found;
  }

  // What holds the job, in words; nothing if it is free.
  std::optional<std::string> holder(const JobRow& row) const {
    if (row.status == Status::running) {
      const auto owner = owners_.find(row.job_id);
      if (owner == owners_.end()) return "is being run";
      return fmt::format("is being run by process {} on {}: stop that run first", owner->second.pid,
                         owner->second.host);
    }
    if (row.status != Status::lent) return std::nullopt;
    Query rows = store_.query(fmt::format(
        "SELECT shard FROM loans JOIN shards USING (shard) WHERE job_id = {} AND returned IS NULL",
        row.job_id));
    const auto shard = rows.next();
    const auto* name = shard ? std::get_if<std::string>(shard->data()) : nullptr;
    return fmt::format("is lent to {0}: merge or recall {0} first", name ? *name : "a shard");
  }

 private:
  const Reader& store_;
  std::map<std::int64_t, JobRow> jobs_;
  std::map<std::int64_t, CheckpointInfo> states_;
  std::map<std::int64_t, Owner> owners_;
  std::map<std::int64_t, std::set<std::int64_t>> users_;  // of each equilibration
};

struct Terms {
  bool with_rows = false;   // what is stored goes, too
  bool ends_begun = false;  // what was begun ends where it is stored
};

std::string state_of(const JobRow& row, const Stored& stored, bool is_begun) {
  if (row.status == Status::collapsed) return "has ended in inelastic collapse";
  if (row.status == Status::failed) return "has failed";
  if (row.status != Status::pending) return fmt::format("is {}", name(row.status));
  if (!is_begun) return "is planned";
  if (!stored.has_state) return "begins again, since its state was damaged";
  return fmt::format("was begun, and is stored up to tau = {}", stored.tau);
}

Dismissal dismissal_of(const Inventory& inventory, const JobRow& row, const Terms& terms) {
  const Stored stored = inventory.stored(row.job_id);
  const bool is_open = row.status == Status::pending || row.status == Status::failed;
  const bool is_begun = stored.samples > 0 || stored.bytes > 0;
  Dismissal found{.row = row,
                  .fate = Fate::kept,
                  .why = state_of(row, stored, is_begun),
                  .tau_max = row.tau_max,
                  .samples = stored.samples,
                  .bytes = stored.bytes};
  if (auto holder = inventory.holder(row)) {
    found.fate = Fate::held;
    found.why = *std::move(holder);
  } else if (terms.with_rows || (is_open && !is_begun)) {
    found.fate = Fate::removed;
  } else if (terms.ends_begun && row.status == Status::pending && stored.has_state &&
             stored.tau < row.tau_max) {
    found.fate = Fate::ends;
    found.tau_max = stored.tau;
  }
  return found;
}

using Fates = std::map<std::int64_t, Dismissal>;

bool is_removed(const Fates& fates, std::int64_t job_id) {
  const auto found = fates.find(job_id);
  return found != fates.end() && found->second.fate == Fate::removed;
}

// An equilibration stays as long as a job starts from it.
void judge_equilibration(const Inventory& inventory, const JobRow& row, const Terms& terms,
                         bool is_chosen, Fates& fates) {
  Dismissal found = dismissal_of(inventory, row, terms);
  if (found.fate != Fate::held) {
    const auto users = inventory.users(row.job_id);
    const auto user = std::ranges::find_if(
        users, [&](std::int64_t job_id) { return !is_removed(fates, job_id); });
    if (user != users.end()) {
      found.fate = Fate::kept;
      found.why = fmt::format("job {} starts from it", *user);
    } else if (row.status == Status::pending || row.status == Status::failed) {
      found.fate = Fate::removed;  // a gas on its way to equilibrium is of no use by itself
      found.why = "no job starts from it";
    }
  }
  if (is_chosen || found.fate == Fate::removed) fates.emplace(row.job_id, std::move(found));
}

// What becomes of these jobs, and of the equilibrations that only they start from, unless a job is
// needed otherwise.
std::vector<Dismissal> dismissals(const Inventory& inventory, const std::set<std::int64_t>& chosen,
                                  const Terms& terms, const std::set<std::int64_t>& needed = {}) {
  Fates fates;
  std::set<std::int64_t> equilibrations;
  for (const std::int64_t job_id : chosen) {
    const JobRow& row = inventory.job(job_id);
    if (row.job.kind == Kind::equilibration) {
      equilibrations.insert(job_id);
      continue;
    }
    Dismissal found = dismissal_of(inventory, row, terms);
    if (found.fate == Fate::removed) equilibrations.insert(row.equilibration_id.value());
    fates.emplace(job_id, std::move(found));
  }
  for (const std::int64_t job_id : equilibrations)
    if (!needed.contains(job_id))
      judge_equilibration(inventory, inventory.job(job_id), terms, chosen.contains(job_id), fates);
  std::vector<Dismissal> all;
  all.reserve(fates.size());
  for (auto& [job_id, each] : fates) all.push_back(std::move(each));
  return all;
}

bool is_same(const Target& one, const Target& other) {
  return one.series == other.series && one.quantity == other.quantity &&
         one.tau_from == other.tau_from && one.tau_to == other.tau_to;
}

// A job that the plan now asks less of.
std::optional<Dismissal> shortened(const Inventory& inventory, const JobRow& row,
                                   const Planned& planned) {
  const bool may_be = row.status != Status::done && row.status != Status::collapsed;
  if (row.job.kind != Kind::cooling || !may_be || planned.tau_max >= row.tau_max)
    return std::nullopt;
  const Stored stored = inventory.stored(row.job_id);
  Dismissal found{.row = row,
                  .fate = Fate::ends,
                  .why = "was to run longer",
                  .tau_max = std::max(planned.tau_max, stored.tau),
                  .samples = stored.samples,
                  .bytes = stored.bytes};
  if (auto holder = inventory.holder(row)) {
    found.fate = Fate::held;
    found.why = *std::move(holder);
    found.tau_max = row.tau_max;
  } else if (found.tau_max >= row.tau_max) {
    return std::nullopt;
  }
  return found;
}

// The same for a plan whose jobs may or may not be in the store yet.
Revision revision(const Reader& store, const std::vector<Planned>& plan,
                  const std::vector<Target>& targets) {
  const Inventory inventory(store);
  std::map<std::string, std::int64_t> ids;
  for (const auto& [id, row] : inventory.jobs()) ids.emplace(identity(row.job), id);
  std::set<std::string> planned_by_target;
  for (const Target& target : targets) planned_by_target.insert(target.series);

  Revision found;
  std::set<std::int64_t> wanted;
  for (const Planned& planned : plan)
    if (const auto id = ids.find(identity(planned.job)); id != ids.end()) {
      wanted.insert(id->second);
      if (auto shorter = shortened(inventory, inventory.job(id->second), planned))
        found.shortened.push_back(*std::move(shorter));
    }
  std::set<std::int64_t> others;
  for (const auto& [id, row] : inventory.jobs())
    if (!wanted.contains(id) && !planned_by_target.contains(row.series)) others.insert(id);
  // Equilibrations of jobs that stay are not mentioned.
  std::set<std::int64_t> needed = wanted;
  for (const auto& [id, row] : inventory.jobs())
    if (row.job.kind == Kind::equilibration && !inventory.users(id).empty()) others.erase(id);
  found.jobs = dismissals(inventory, others, {}, needed);
  for (const Target& target : store.targets())
    if (std::ranges::none_of(targets, [&](const Target& one) { return is_same(one, target); }))
      found.targets.push_back(target);
  return found;
}

void execute(SQLite::Database& sqlite, const std::string& sql, std::int64_t job_id) {
  SQLite::Statement statement(sqlite, sql);
  statement.bind(1, job_id);
  statement.exec();
}

void remove(Database& database, std::int64_t job_id) {
  for (const char* table :
       {"loans", "checkpoint_chunks", "checkpoints", "snapshot_chunks", "snapshots", "results",
        "invariants", "fields", "profiles", "samples", "digests", "jobs"})
    execute(database.sqlite(), fmt::format("DELETE FROM {} WHERE job_id = ?", table), job_id);
  database.digests().removed(job_id);
}

// Its expected cost is that of a run to tau_max.
void end_at(Database& database, const Dismissal& job) {
  database.digests().must_match(job.row.job_id, Part::jobs);
  SQLite::Statement statement(database.sqlite(), R"(
    UPDATE jobs SET expected_cpu_seconds = expected_cpu_seconds * :tau_max / tau_max,
                    tau_max = :tau_max
    WHERE job_id = :job_id)");
  statement.bind(":tau_max", job.tau_max);
  statement.bind(":job_id", job.row.job_id);
  statement.exec();
}

void remove(Database& database, const std::vector<Target>& targets) {
  if (targets.empty()) return;
  for (const char* table : {"target_predictions", "targets"}) {
    database.digests().must_match_table(table);
    SQLite::Statement statement(database.sqlite(),
                                fmt::format("DELETE FROM {} WHERE series = ? AND quantity = ? AND "
                                            "tau_from = ? AND tau_to = ?",
                                            table));
    for (const Target& target : targets) {
      statement.reset();
      statement.bind(1, target.series);
      statement.bind(2, target.quantity);
      statement.bind(3, target.tau_from);
      statement.bind(4, target.tau_to);
      statement.exec();
    }
  }
}

// Cooling jobs first: they refer to their equilibrations.
void carry_out(Database& database, const Revision& revision) {
  for (const Kind kind : {Kind::cooling, Kind::equilibration})
    for (const Dismissal& job : revision.jobs)
      if (job.row.job.kind == kind && job.fate == Fate::removed) remove(database, job.row.job_id);
  for (const auto* jobs : {&revision.jobs, &revision.shortened})
    for (const Dismissal& job : *jobs)
      if (job.fate == Fate::ends) end_at(database, job);
  remove(database, revision.targets);
}

void must_not_be_shard(const Reader& store) {
  if (const auto name = store.shard_name())
    throw StoreError(fmt::format(
        "{}: is {}, a shard; its jobs belong to the store that lent them, and are changed there",
        store.path().string(), *name));
}

}  // namespace

Revision revision_of_cancel(const Reader& store, const Choice& choice, bool with_rows) {
  must_not_be_shard(store);
  Revision found;
  found.jobs = dismissals(Inventory(store), chosen_jobs(store, choice),
                          {.with_rows = with_rows, .ends_begun = true});
  std::set<std::string> series;
  for (const Dismissal& job : found.jobs)
    if (job.fate == Fate::removed || job.fate == Fate::ends) series.insert(job.row.series);
  for (Target& target : store.targets())
    if (series.contains(target.series)) found.targets.push_back(std::move(target));
  return found;
}

Revision revision_of_replace(const Reader& store, const std::vector<Planned>& plan,
                             const std::vector<Target>& targets) {
  must_not_be_shard(store);
  Revision found = revision(store, plan, targets);
  found.outcomes = store.preview(plan);
  return found;
}

Revision Revised::cancel(const Choice& choice, bool with_rows) {
  // The jobs are looked at again in the transaction that writes: a worker may have claimed one
  // meanwhile.
  return database().transaction([&] {
    Revision found = revision_of_cancel(*this, choice, with_rows);
    carry_out(database(), found);
    return found;
  });
}

Revision Revised::replace(const std::vector<Planned>& plan, const std::vector<Target>& targets) {
  return database().transaction([&] {
    must_not_be_shard(*this);
    Revision found = revision(*this, plan, targets);
    carry_out(database(), found);
    found.outcomes.resize(plan.size());
    for (const Kind kind : {Kind::equilibration, Kind::cooling})
      for (std::size_t k = 0; k < plan.size(); ++k)
        if (plan[k].job.kind == kind) found.outcomes[k] = add_or_extend(database(), plan[k]);
    return found;
  });
}

bool Revised::give_back_space() {
  if (!close_log(patience)) return false;
  return database().guarded([&] {
    sqlite3* handle = database().sqlite().getHandle();
    // SQLite writes what is left to a temporary file that it attaches, and copies it back.
    sqlite3_limit(handle, SQLITE_LIMIT_ATTACHED, 1);
    const bool is_done = database().sqlite().tryExec("VACUUM") == SQLITE_OK;
    const int error = sqlite3_errcode(handle);
    sqlite3_limit(handle, SQLITE_LIMIT_ATTACHED, 0);
    if (!is_done && (error & 0xff) != SQLITE_BUSY) throw SQLite::Exception(handle, error);
    return is_done;
  });
}

}  // namespace haff::schema
