// SPDX-License-Identifier: GPL-3.0-or-later

// Digests of rows: whether what a store says is what was written into it (017-digests.sql).
//
// Every transaction that writes keeps them (Database::transaction), whichever statements it runs:
// SQLite reports which rows of jobs and of the tables with one row a job have changed, and those
// are digested again before the commit. Three things are left to the code that writes:
//
//   * before it changes a row of jobs, or a small table, it checks that the old one is as it was
//     written: must_match(). Otherwise a flipped bit would be digested again, and would count as
//     right from then on. A row that was changed unchecked is a std::logic_error at the commit.
//   * rows of samples, profiles, fields and snapshots are added to their digest: added();
//   * loans of a job that change are digested again: changed().
//
// Private to schema/.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "schema/digests/part.hpp"

namespace haff::schema {

// A table's columns without job_id (jobs: all), and the digest of a row that has been selected
// with them.
class DigestedTable {
 public:
  DigestedTable(SQLite::Database& sqlite, const char* name);

  const std::string& columns() const { return list_; }  // for SELECT and RETURNING
  const std::vector<std::string>& names() const { return names_; }
  std::uint64_t digest(SQLite::Statement& row) const;
  std::uint64_t digest_of_none() const { return name_; }

  // A value: its type (0 NULL, 1 integer, 2 real, 3 text, 4 BLOB) and its 64 bits.
  struct Word {
    std::uint64_t type = 0, value = 0;
    bool operator==(const Word&) const = default;
  };
  static Word word(const SQLite::Column& value);
  // A column of reals may give a whole number as an integer: RETURNING does.
  static Word word(const SQLite::Column& value, bool is_real);
  std::uint64_t digest(const std::vector<Word>& row) const;

 private:
  struct Column {
    std::uint64_t name = 0;
    bool is_real = false;
    Word by_default;
  };
  std::uint64_t name_;
  std::string list_;
  std::vector<std::string> names_;
  std::vector<Column> columns_;
};

class Digests {
 public:
  explicit Digests(SQLite::Database& sqlite) : sqlite_(sqlite) {}
  Digests(const Digests&) = delete;
  Digests& operator=(const Digests&) = delete;

  const DigestedTable& table(Part part);

  // ---- reading ----

  bool has(std::int64_t job_id);
  // The digest of these rows as it is stored; nothing if they have none.
  std::optional<std::uint64_t> stored(std::int64_t job_id, Part part);
  // The digest of the rows as they are.
  std::uint64_t present(std::int64_t job_id, Part part);
  // Throws Altered if the two differ.
  void must_match(std::int64_t job_id, Part part);
  // The same of a table as a whole. Nothing: it has no digest.
  std::optional<bool> matches(const std::string& table);
  std::vector<std::string> wrong_tables();

  // ---- writing ----

  // From here to settle(), or to drop() if the transaction is rolled back, changes are noticed.
  void begin();
  void settle();
  void drop() noexcept;

  void must_match_table(const std::string& table);
  // A row was added, whose digest is this.
  void added(std::int64_t job_id, Part part, std::uint64_t digest);
  // These rows have changed, or were checked by other means, and are digested as they are now.
  void changed(std::int64_t job_id, Part part);
  void changed_table(const std::string& table);
  // From here on these rows have no digest.
  void forget(std::int64_t job_id, Part part);
  // All rows of this job have just been deleted. Its number may be given to another one.
  void removed(std::int64_t job_id);
  // This job's row is wrong and stays known as such, whatever changes in it.
  void leave_alone(std::int64_t job_id);
  // Tables without a digest get one: of a store that is new, or that was brought forward.
  void digest_tables();

 private:
  using Row = std::array<std::optional<std::uint64_t>, part_count>;

  static void notice(void* self, int operation, const char* database, const char* table,
                     long long rowid);
  Row& row(std::int64_t job_id);
  SQLite::Statement& rows_of(Part part);
  const std::vector<Part>& parts();
  std::uint64_t of_table(const std::string& table);

  SQLite::Database& sqlite_;
  std::array<std::unique_ptr<DigestedTable>, part_count> tables_;
  std::array<std::unique_ptr<SQLite::Statement>, part_count> rows_;
  std::unique_ptr<SQLite::Statement> read_, write_;
  std::vector<Part> parts_;

  // Of the transaction that is on.
  bool is_writing_ = false;
  std::map<std::int64_t, Row> known_;
  std::set<std::int64_t> checked_, left_alone_, new_, touched_;
  std::set<std::pair<std::int64_t, Part>> changed_;
  std::set<std::string> checked_tables_, changed_tables_;
};

// A transaction's changes are noticed while this lives.
class DigestsOfChanges {
 public:
  explicit DigestsOfChanges(Digests& digests) : digests_(digests) { digests_.begin(); }
  ~DigestsOfChanges() { digests_.drop(); }
  DigestsOfChanges(const DigestsOfChanges&) = delete;
  DigestsOfChanges& operator=(const DigestsOfChanges&) = delete;

 private:
  Digests& digests_;
};

}  // namespace haff::schema
