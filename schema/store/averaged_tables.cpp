// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/store/averaged_tables.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <memory>
#include <new>
#include <string>
#include <type_traits>
#include <variant>

namespace haff::schema {
namespace {

struct CopiedTable {
  const char* name;
  const char* rows;
};

constexpr CopiedTable tables[] = {
    {"mean_series", "SELECT * FROM mean_series"},
    {"mean_temperatures", "SELECT * FROM mean_temperatures"},
    {"mean_profiles", "SELECT * FROM mean_profiles"},
    {"mean_tau_c", "SELECT * FROM mean_tau_c"},
    {"target_outcomes", "SELECT * FROM target_outcomes"},
    {"job_effects", "SELECT * FROM job_effects"},
    {"jobs",
     "SELECT job_id, kind, d, e, n, particles, seed, start, equilibrate, sample_every, sample_at, "
     "effects, "
     "observables, tau_max, status, attempts, error, tau_reached, collisions, cpu_seconds, "
     "expected_cpu_seconds, created, started, finished, code_version, host FROM jobs"},
};

void bind(SQLite::Statement& insert, int place, const Value& value) {
  std::visit(
      [&](const auto& held) {
        using Held = std::decay_t<decltype(held)>;
        if constexpr (std::is_same_v<Held, Null>)
          insert.bind(place);
        else if constexpr (std::is_same_v<Held, Blob>)
          insert.bind(place, held.data(), static_cast<int>(held.size()));
        else
          insert.bind(place, held);
      },
      value);
}

// A new table, to which rows are added.
class NewTable {
 public:
  NewTable(SQLite::Database& file, const std::string& name, const std::vector<std::string>& columns)
      : insert_(created(file, name, columns)) {}

  void add(const std::vector<Value>& row) {
    for (std::size_t k = 0; k < row.size(); ++k) bind(insert_, static_cast<int>(k) + 1, row[k]);
    insert_.exec();
    insert_.reset();
  }

 private:
  static SQLite::Statement created(SQLite::Database& file, const std::string& name,
                                   const std::vector<std::string>& columns) {
    std::string names, places;
    for (const std::string& column : columns) {
      const char* comma = names.empty() ? "" : ", ";
      names += comma + column;
      places += std::string(comma) + '?';
    }
    file.exec("CREATE TABLE " + name + " (" + names + ")");
    return {file, "INSERT INTO " + name + " VALUES (" + places + ")"};
  }

  SQLite::Statement insert_;
};

void copy(const Reader& store, const CopiedTable& table, SQLite::Database& file) {
  Query rows = store.query(table.rows);
  NewTable copied(file, table.name, rows.columns());
  while (const auto row = rows.next()) copied.add(*row);
}

struct Free {
  void operator()(unsigned char* bytes) const { sqlite3_free(bytes); }
};

}  // namespace

std::vector<std::byte> averaged_tables(const Reader& store,
                                       const std::vector<ComputedTable>& beside) try {
  store.must_match_digests({Part::samples, Part::profiles, Part::results});
  SQLite::Database file(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  SQLite::Transaction transaction(file);
  for (const CopiedTable& table : tables) copy(store, table, file);
  for (const ComputedTable& table : beside) {
    NewTable computed(file, table.name, table.columns);
    for (const auto& row : table.rows) computed.add(row);
  }
  transaction.commit();
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, Free> bytes(
      sqlite3_serialize(file.getHandle(), "main", &size, 0));
  if (!bytes) throw std::bad_alloc();
  const auto* begin = reinterpret_cast<const std::byte*>(bytes.get());
  return {begin, begin + size};
} catch (const SQLite::Exception& error) {
  throw StoreError(store.path().string() + ": its averages cannot be gathered: " + error.what());
}

}  // namespace haff::schema
