// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/store/faults.hpp"

#include <array>
#include <optional>
#include <string_view>

#include "schema/database/database.hpp"

namespace haff::schema {

namespace {

// In the words of integrity_check.
bool is_of_an_index(std::string_view fault) {
  return fault.starts_with("wrong # of entries in index ") ||
         (fault.starts_with("row ") &&
          fault.find(" missing from index ") != std::string_view::npos);
}

std::vector<std::string> lines(Database& database, const char* sql) {
  Prepared rows(database, sql);
  std::vector<std::string> found;
  while (rows.executeStep()) found.push_back(rows.getColumn(0).getString());
  return found;
}

// Rows of sqlite_stat1, by which SQLite chooses indexes: table, index or nothing, numbers.
using Statistics = std::vector<std::array<std::optional<std::string>, 3>>;

Statistics statistics(SQLite::Database& sqlite) {
  SQLite::Statement rows(sqlite, "SELECT tbl, idx, stat FROM sqlite_stat1 ORDER BY tbl, idx, stat");
  Statistics found;
  while (rows.executeStep()) {
    auto& row = found.emplace_back();
    for (int k = 0; k < 3; ++k)
      if (const auto value = rows.getColumn(k); !value.isNull())
        row[static_cast<std::size_t>(k)] = value.getString();
  }
  return found;
}

Statistics statistics_of_a_new_store() {
  return statistics(Database::in_memory()->sqlite());
}

}  // namespace

Faults faults_of(Database& database) {
  Faults faults;
  for (const char* check : {"SELECT integrity_check FROM pragma_integrity_check "
                            "WHERE integrity_check <> 'ok'",
                            "SELECT \"table\" || ' row ' || coalesce(rowid, '?') || "
                            "' refers to a row that is missing in ' || parent "
                            "FROM pragma_foreign_key_check"})
    try {
      database.guarded([&] {
        for (const std::string& line : lines(database, check))
          (is_of_an_index(line) ? faults.derived : faults.file).push_back(line);
      });
    } catch (const Damage& damage) {
      faults.file.emplace_back(damage.what());  // the check itself could not go on
    }
  if (faults.file.empty() && database.guarded([&] { return statistics(database.sqlite()); }) !=
                                 statistics_of_a_new_store())
    faults.derived.emplace_back(
        "the table sqlite_stat1, by which SQLite chooses its indexes, is not as this program "
        "makes it");
  return faults;
}

void make_derived_anew(Database& database) {
  SQLite::Database& sqlite = database.sqlite();
  sqlite.exec("REINDEX");
  sqlite.exec("DELETE FROM sqlite_stat1");
  SQLite::Statement insert(sqlite, "INSERT INTO sqlite_stat1 (tbl, idx, stat) VALUES (?, ?, ?)");
  for (const auto& row : statistics_of_a_new_store()) {
    insert.reset();
    insert.clearBindings();
    for (int k = 0; k < 3; ++k)
      if (const auto& value = row[static_cast<std::size_t>(k)]) insert.bind(k + 1, *value);
    insert.exec();
  }
}

}  // namespace haff::schema
