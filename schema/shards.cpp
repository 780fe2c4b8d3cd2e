#include "schema/shards.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <string_view>
#include <vector>

#include "schema/database.hpp"
#include "schema/rows.hpp"
#include "schema/store.hpp"

namespace haff::schema {
namespace {

const std::string now = "strftime('%Y-%m-%dT%H:%M:%fZ', 'now')";

// Tables whose rows are written once and never change, and those that hold the newest state of a
// job. All have a column job_id.
constexpr std::array written_once{"samples", "profiles", "fields"};
constexpr std::array newest_state{"checkpoints", "checkpoint_chunks", "invariants", "results"};

// Columns of jobs that belong to this store, not to the job.
const std::set<std::string> of_this_store{"job_id",        "equilibration_id", "status",
                                          "lease",         "owner_boot_id",    "owner_pid",
                                          "owner_started", "renewed"};

// Columns of jobs that say how far the job is, and where it was worked on.
constexpr std::array progress_columns{"tau",         "collisions",     "attempts", "error",
                                      "starts_over", "started",        "finished", "code_version",
                                      "host",        "physics_version"};

// Two C libraries differ in the last digits of a logarithm, two FFT libraries in those of a
// transform. Everything else is decided by the trajectory, and equal in every bit.
double tolerance(std::string_view column) {
  constexpr double logarithm = 1e-9, transform = 1e-6;  // relative
  if (column == "gamma_ratio" || column == "tau_c" || column == "time_c") return logarithm;
  if (column == "value" || column == "correlation_trace") return transform;
  return 0;
}

// Same as the one in SQLite: NULL, an integer, a real, a text or a BLOB.
void bind(SQLite::Statement& statement, int place, const SQLite::Column& value) {
  if (value.isNull())
    statement.bind(place);
  else if (value.isInteger())
    statement.bind(place, value.getInt64());
  else if (value.isFloat())
    statement.bind(place, value.getDouble());
  else if (value.isText())
    statement.bind(place, value.getString());
  else
    statement.bind(place, value.getBlob(), value.getBytes());
}

std::string described(const SQLite::Column& value) {
  if (value.isNull()) return "NULL";
  if (value.isFloat()) return fmt::format("{:.17g}", value.getDouble());
  if (value.isBlob()) return fmt::format("a BLOB of {} bytes", value.getBytes());
  return value.getString();
}

bool is_same(const SQLite::Column& a, const SQLite::Column& b, double tolerance) {
  if (a.getType() != b.getType()) return false;
  if (a.isNull()) return true;
  if (a.isInteger()) return a.getInt64() == b.getInt64();
  if (a.isFloat()) {
    const double x = a.getDouble(), y = b.getDouble();
    if (std::memcmp(&x, &y, sizeof x) == 0) return true;
    return std::abs(x - y) <= tolerance * std::max(std::abs(x), std::abs(y));
  }
  return a.getBytes() == b.getBytes() &&
         std::memcmp(a.getBlob(), b.getBlob(), static_cast<std::size_t>(a.getBytes())) == 0;
}

// The columns of a table, and those of its primary key, but for job_id.
struct Table {
  std::string name;
  std::vector<std::string> columns, key;
};

Table table_of(SQLite::Database& sqlite, const std::string& name) {
  Table table{name, {}, {}};
  SQLite::Statement info(sqlite, "SELECT name, pk FROM pragma_table_info(?)");
  info.bind(1, name);
  while (info.executeStep()) {
    const std::string column = info.getColumn(0).getString();
    if (column == "job_id") continue;
    table.columns.push_back(column);
    if (info.getColumn(1).getInt() > 0) table.key.push_back(column);
  }
  return table;
}

std::string list(const std::vector<std::string>& columns, std::string_view form) {
  std::string text;
  for (const std::string& column : columns)
    text += (text.empty() ? "" : ", ") + fmt::format(fmt::runtime(form), column);
  return text;
}

std::string all_equal(const std::vector<std::string>& columns) {
  std::string text;
  for (const std::string& column : columns) text += fmt::format(" AND {0} = :{0}", column);
  return text;
}

// One job in two stores.
struct Pair {
  SQLite::Database& ours;
  SQLite::Database& theirs;
  std::int64_t our_id, their_id;
  std::string where;  // for messages: our file, "and", theirs
};

void must_be_same(const Pair& pair, const Table& table, const SQLite::Statement& theirs) {
  SQLite::Statement ours(pair.ours,
                         fmt::format("SELECT {} FROM {} WHERE job_id = :job_id{}",
                                     list(table.columns, "{}"), table.name, all_equal(table.key)));
  ours.bind(":job_id", pair.our_id);
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (std::ranges::find(table.key, table.columns[i]) != table.key.end())
      bind(ours, ours.getIndex((":" + table.columns[i]).c_str()),
           theirs.getColumn(static_cast<int>(i)));
  ours.executeStep();
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const auto a = ours.getColumn(static_cast<int>(i)), b = theirs.getColumn(static_cast<int>(i));
    if (is_same(a, b, tolerance(table.columns[i]))) continue;
    std::string row;
    for (const std::string& key : table.key)
      row += fmt::format(", {} = {}", key, described(theirs.getColumn(key.c_str())));
    throw Damage(fmt::format(
        "{}: the {} of job {}{} differ in {}: {} here, {} there. One of the two computations was "
        "disturbed, or made by another version of the program; nothing of this job was changed",
        pair.where, table.name, pair.our_id, row, table.columns[i], described(a), described(b)));
  }
}

// Adds the rows that we lack, and compares the others. Returns how many were added.
std::int64_t add_rows(const Pair& pair, const Table& table, bool compare) {
  SQLite::Statement theirs(pair.theirs, fmt::format("SELECT {} FROM {} WHERE job_id = ?",
                                                    list(table.columns, "{}"), table.name));
  theirs.bind(1, pair.their_id);
  SQLite::Statement insert(
      pair.ours, fmt::format("INSERT INTO {} (job_id, {}) VALUES (?{}) ON CONFLICT DO NOTHING",
                             table.name, list(table.columns, "{}"), [&] {
                               std::string marks;
                               for (std::size_t i = 0; i < table.columns.size(); ++i)
                                 marks += ", ?";
                               return marks;
                             }()));
  std::int64_t added = 0;
  while (theirs.executeStep()) {
    insert.reset();
    insert.bind(1, pair.our_id);
    for (int i = 0; i < theirs.getColumnCount(); ++i) bind(insert, i + 2, theirs.getColumn(i));
    if (insert.exec() > 0)
      ++added;
    else if (compare)
      must_be_same(pair, table, theirs);
  }
  return added;
}

void drop_rows(SQLite::Database& sqlite, const char* table, std::int64_t job_id) {
  SQLite::Statement statement(sqlite, fmt::format("DELETE FROM {} WHERE job_id = ?", table));
  statement.bind(1, job_id);
  statement.exec();
}

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
    bind(insert, insert.getIndex((":" + columns[static_cast<std::size_t>(i)]).c_str()),
         from.getColumn(i));
  insert.exec();

  const std::int64_t job_id = ours.getLastInsertRowid();
  SQLite::Statement fresh(ours,
                          "UPDATE jobs SET tau = 0, collisions = 0, attempts = 0, error = NULL, "
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

// What our job becomes when it takes over theirs. A job that a plan has made longer meanwhile is
// not done, and one that is still unfinished there stays as it is here.
Status status_after(const JobRow& ours, const JobRow& theirs) {
  if (!has_ended(theirs.status)) return ours.status;
  if (theirs.status == Status::failed)
    return ours.status == Status::done ? Status::done : Status::failed;
  if (theirs.status == Status::done && ours.tau_max > theirs.tau_max)
    return has_ended(ours.status) ? ours.status : Status::pending;
  return theirs.status;
}

void take_state(const Pair& pair) {
  for (const char* table : {"checkpoint_chunks", "checkpoints", "invariants", "results"})
    drop_rows(pair.ours, table, pair.our_id);
  for (const char* table : newest_state) add_rows(pair, table_of(pair.ours, table), false);
}

void take_progress(const Pair& pair, Status status) {
  std::vector<std::string> columns(progress_columns.begin(), progress_columns.end());
  SQLite::Statement from(pair.theirs,
                         fmt::format("SELECT {} FROM jobs WHERE job_id = ?", list(columns, "{}")));
  from.bind(1, pair.their_id);
  from.executeStep();
  SQLite::Statement update(
      pair.ours, fmt::format("UPDATE jobs SET {}, status = :status, lease = lease + 1, "
                             "owner_boot_id = NULL, owner_pid = NULL, owner_started = NULL, "
                             "renewed = NULL WHERE job_id = :job_id",
                             list(columns, "{0} = :{0}")));
  for (int i = 0; i < from.getColumnCount(); ++i)
    bind(update, update.getIndex((":" + columns[static_cast<std::size_t>(i)]).c_str()),
         from.getColumn(i));
  update.bind(":status", std::string(name(status)));
  update.bind(":job_id", pair.our_id);
  update.exec();
}

// Adds what this shard has spent on the job since it was last merged.
void take_cost(SQLite::Database& sqlite, const std::string& shard, std::int64_t job_id,
               double cpu_seconds) {
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
        lent_now.insert(job_id);
        SQLite::Statement lend(sqlite, "UPDATE jobs SET status = 'lent' WHERE job_id = ?");
        lend.bind(1, job_id);
        lend.exec();
        SQLite::Statement note(
            sqlite, "INSERT INTO loans (shard, job_id, cpu_seconds_before) VALUES (?, ?, ?)");
        note.bind(1, loan.shard);
        note.bind(2, job_id);
        note.bind(3, row.progress.cpu_seconds);
        note.exec();
      }
    }
  });
}

void Store::become_shard(const std::string& campaign_id, const std::string& name) {
  database().transaction([&] {
    SQLite::Statement statement(database().sqlite(),
                                "UPDATE campaign SET campaign_id = ?, shard = ?");
    statement.bind(1, campaign_id);
    statement.bind(2, name);
    statement.exec();
  });
}

Arrival Store::take_over(const Reader& other, std::int64_t job_id, const std::string& shard) {
  return other.database().snapshot([&] {
    SQLite::Database& theirs = other.database().sqlite();
    return database().transaction([&] {
      SQLite::Database& ours = database().sqlite();
      const auto known = id_of(ours, identity_of(theirs, job_id));
      const std::int64_t our_id = known ? *known : add_job(ours, theirs, job_id);
      const Pair pair{ours, theirs, our_id, job_id,
                      path().string() + " and " + other.path().string()};
      const JobRow here = row_of(ours, our_id), there = row_of(theirs, job_id);

      Arrival arrival;
      for (const char* table : written_once)
        arrival.rows += add_rows(pair, table_of(ours, table), true);
      const double our_tau = kept_tau(ours, here), their_tau = kept_tau(theirs, there);
      const bool has_ended_there = has_ended(there.status) && !has_ended(here.status);
      arrival.advanced = their_tau > our_tau || (their_tau == our_tau && has_ended_there);
      if (arrival.advanced) {
        take_state(pair);
        take_progress(pair, status_after(here, there));
      } else if (their_tau == our_tau) {
        add_rows(pair, table_of(ours, "results"), true);
      }
      if (!shard.empty()) take_cost(ours, shard, our_id, there.progress.cpu_seconds);
      return arrival;
    });
  });
}

void Store::note_merge(const std::string& shard) {
  database().transaction([&] {
    SQLite::Database& sqlite = database().sqlite();
    must_be_known(sqlite, path(), shard);
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
    SQLite::Statement back(
        sqlite, "UPDATE shards SET returned = coalesce(returned, " + now + ") WHERE shard = ?");
    back.bind(1, shard);
    back.exec();
    SQLite::Statement jobs(sqlite, R"(
      UPDATE jobs SET status = 'pending'
      WHERE status = 'lent' AND job_id IN (SELECT job_id FROM loans WHERE shard = :shard)
        AND NOT EXISTS (SELECT 1 FROM loans JOIN shards USING (shard)
                        WHERE loans.job_id = jobs.job_id AND shards.returned IS NULL))");
    jobs.bind(":shard", shard);
    return static_cast<std::int64_t>(jobs.exec());
  });
}

}  // namespace haff::schema
