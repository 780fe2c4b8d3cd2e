// SPDX-License-Identifier: GPL-3.0-or-later

// One column of a row, checked. A store is a file that may come from anywhere. Its values are input
// and are checked here once: no text of it reaches a terminal or a figure as a command, and the
// program believes no number that it would not have written itself. Private to
// schema/.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace haff::schema {

// A value that this program does not write. Database turns it into Damage, with the file's name.
struct BadValue : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// What is stored is not what was written, as a digest shows.
struct Altered : BadValue {
  using BadValue::BadValue;
};

// Whole numbers in JSON and in doubles are exact up to here.
inline constexpr std::int64_t largest_whole = std::int64_t{1} << 53;

// UTF-8 without control characters: what can be printed as it is, on one line.
bool is_printable(std::string_view text);

// The same with a blank for each byte that is not printable, for texts of other libraries (the
// message of an exception) on their way into the store.
std::string printable(std::string text);

// Each throws BadValue, naming the column, unless the value is of this type and in this range.
std::int64_t integer(const SQLite::Statement& row, const char* column,
                     std::int64_t least = std::numeric_limits<std::int64_t>::min(),
                     std::int64_t most = std::numeric_limits<std::int64_t>::max());
double real(const SQLite::Statement& row, const char* column);  // finite
double not_negative(const SQLite::Statement& row, const char* column);
double positive(const SQLite::Statement& row, const char* column);
std::string text(const SQLite::Statement& row, const char* column);  // printable
std::string timestamp(const SQLite::Statement& row,
                      const char* column);  // 2003-09-05T12:00:00.000Z

// The same of a column that may be NULL: `read` is one of those above.
template <class Read>
auto optional(const SQLite::Statement& row, const char* column, Read&& read)
    -> std::optional<decltype(read(row, column))> {
  if (row.isColumnNull(column)) return std::nullopt;
  return read(row, column);
}

inline std::optional<double> optional_real(const SQLite::Statement& row, const char* column) {
  return optional(row, column, real);
}

inline std::optional<std::string> optional_text(const SQLite::Statement& row, const char* column) {
  return optional(row, column, text);
}

}  // namespace haff::schema
