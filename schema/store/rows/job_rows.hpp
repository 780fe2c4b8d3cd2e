// SPDX-License-Identifier: GPL-3.0-or-later

// The rows that two stores have of one job: copied, compared, put in each other's place. Private to
// schema/.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "schema/database/database.hpp"
#include "schema/digests/part.hpp"

namespace haff::schema {

// One job in one store.
struct RowsOfJob {
  Database& database;
  std::int64_t job_id;

  SQLite::Database& sqlite() const { return database.sqlite(); }
};

// By how much a column may differ between two machines: two C libraries differ in the last digits
// of a logarithm, two FFT libraries in those of a transform. All else is decided by the trajectory,
// and equal in every bit. [relative]
double last_digits(std::string_view column);

// The same as what is in SQLite: NULL, an integer, a real, a text or a BLOB.
void bind_value(SQLite::Statement& statement, int place, const SQLite::Column& value);

// A value with all its digits, for a message.
std::string described(const SQLite::Column& value);

// "a, b, c", each in a form such as ":{0}".
std::string list(const std::vector<std::string>& columns, std::string_view form);

// The columns of a table, and those of its primary key, but for job_id.
struct Table {
  std::string name;
  std::vector<std::string> columns, key;
};
Table table_of(SQLite::Database& sqlite, const std::string& name);

// Adds those rows of theirs that we lack; the second also compares the others, and throws Damage if
// one differs: it names job, row, column and both values. Returns how many were added.
std::int64_t add_rows(const RowsOfJob& ours, const RowsOfJob& theirs, const std::string& table);
std::int64_t add_and_compare_rows(const RowsOfJob& ours, const RowsOfJob& theirs, Part part);

void drop_rows(const RowsOfJob& ours, const std::string& table);

// The table that holds the bytes of the rows of this part; null if they have none.
const char* chunks_of(Part part);

// Drops those of our rows that differ from theirs, or that they lack. What differs in last digits
// alone may be another machine's.
enum class LastDigits { may_differ, must_agree };
void drop_differing_rows(const RowsOfJob& ours, const RowsOfJob& theirs, Part part,
                         LastDigits last_digits);

// Where the rows of a table differ, those that one of the two lacks among them, in the order of the
// primary key.
std::vector<Difference> differences(const RowsOfJob& ours, const RowsOfJob& theirs, Part part);

}  // namespace haff::schema
