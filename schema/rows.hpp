// Rows of the store's tables as the structs of store.hpp. Private to this folder.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <string>

#include "schema/store.hpp"

namespace haff::schema {

inline std::int64_t integer(const SQLite::Statement& row, const char* column) {
  return row.getColumn(column).getInt64();
}

inline double real(const SQLite::Statement& row, const char* column) {
  return row.getColumn(column).getDouble();
}

inline std::string text(const SQLite::Statement& row, const char* column) {
  return row.getColumn(column).getString();
}

inline std::optional<double> optional_real(const SQLite::Statement& row, const char* column) {
  if (row.isColumnNull(column)) return std::nullopt;
  return real(row, column);
}

inline std::optional<std::string> optional_text(const SQLite::Statement& row, const char* column) {
  if (row.isColumnNull(column)) return std::nullopt;
  return text(row, column);
}

Job job_of(const SQLite::Statement& row);
JobRow job_row(const SQLite::Statement& row);
Owner owner(const SQLite::Statement& row);
Progress progress_of(const SQLite::Statement& row);
Sample sample(const SQLite::Statement& row);
CheckpointInfo checkpoint_info(const SQLite::Statement& row);

// [1,2,3], as in the column targets.pilots. And back.
std::string seeds_text(const std::vector<std::uint64_t>& seeds);
std::vector<std::uint64_t> seeds_in(const std::string& text);

// What adding this job to the store as it is would do.
Outcome outcome(SQLite::Database& sqlite, const Planned& planned);

}  // namespace haff::schema
