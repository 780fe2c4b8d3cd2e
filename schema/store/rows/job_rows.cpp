// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/store/rows/job_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <variant>

namespace haff::schema {

namespace {

// Tables whose rows have digests that grow with each row.
constexpr std::array grown{Part::samples, Part::profiles, Part::fields, Part::snapshots};

std::optional<Part> grown_part(const std::string& table) {
  for (const Part part : grown)
    if (table == name(part)) return part;
  return std::nullopt;
}

enum class Likeness { same, in_last_digits, different };

Likeness likeness(const SQLite::Column& a, const SQLite::Column& b, double tolerance) {
  const auto when = [](bool same) { return same ? Likeness::same : Likeness::different; };
  if (a.getType() != b.getType()) return Likeness::different;
  if (a.isNull()) return Likeness::same;
  if (a.isInteger()) return when(a.getInt64() == b.getInt64());
  if (a.isFloat()) {
    const double x = a.getDouble(), y = b.getDouble();
    if (std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y)) return Likeness::same;
    const bool is_near = std::abs(x - y) <= tolerance * std::max(std::abs(x), std::abs(y));
    return is_near ? Likeness::in_last_digits : Likeness::different;
  }
  const auto bytes = static_cast<std::size_t>(a.getBytes());
  return when(a.getBytes() == b.getBytes() &&
              (bytes == 0 || std::memcmp(a.getBlob(), b.getBlob(), bytes) == 0));
}

std::string all_equal(const std::vector<std::string>& columns) {
  std::string text;
  for (const std::string& column : columns) text += fmt::format(" AND {0} = :{0}", column);
  return text;
}

// The rows of a job, in the order of their key.
SQLite::Statement rows(const RowsOfJob& job, const Table& table) {
  SQLite::Statement statement(
      job.sqlite(),
      fmt::format("SELECT {} FROM {} WHERE job_id = ?{}", list(table.columns, "{}"), table.name,
                  table.key.empty() ? "" : " ORDER BY " + list(table.key, "{}")));
  statement.bind(1, job.job_id);
  return statement;
}

// "tau = 3, x = 0.5"
std::string place(SQLite::Statement& row, const Table& table) {
  std::string text;
  for (const std::string& key : table.key)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key,
                        row.getColumn(key.c_str()).isFloat()
                            ? fmt::format("{}", row.getColumn(key.c_str()).getDouble())
                            : described(row.getColumn(key.c_str())));
  return text;
}

// Below zero if the key of a comes before that of b, above if after. Keys are numbers and names.
int order(SQLite::Statement& a, SQLite::Statement& b, const Table& table) {
  for (const std::string& key : table.key) {
    const auto x = a.getColumn(key.c_str()), y = b.getColumn(key.c_str());
    if (x.isText() && y.isText()) {
      if (const int way = x.getString().compare(y.getString()); way != 0) return way;
    } else if (x.getDouble() != y.getDouble()) {
      return x.getDouble() < y.getDouble() ? -1 : 1;
    }
  }
  return 0;
}

void compare(SQLite::Statement& ours, SQLite::Statement& theirs, const Table& table, Part part,
             std::vector<Difference>& found) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const auto a = ours.getColumn(static_cast<int>(i)), b = theirs.getColumn(static_cast<int>(i));
    const Likeness how = likeness(a, b, last_digits(table.columns[i]));
    if (how != Likeness::same)
      found.push_back({.part = part,
                       .row = place(ours, table),
                       .column = table.columns[i],
                       .here = described(a),
                       .there = described(b),
                       .is_in_last_digits = how == Likeness::in_last_digits});
  }
}

// Both stores' rows side by side: `each` is given those of ours, with how they differ. Returns what
// we lack.
template <class Each>
std::vector<Difference> walk(const RowsOfJob& ours, const RowsOfJob& theirs, const Table& table,
                             Part part, Each&& each) {
  SQLite::Statement here = rows(ours, table), there = rows(theirs, table);
  std::vector<Difference> lacking;
  bool has_ours = here.executeStep(), has_theirs = there.executeStep();
  while (has_ours || has_theirs) {
    const int way = !has_theirs ? -1 : !has_ours ? 1 : order(here, there, table);
    std::vector<Difference> found;
    if (way == 0) compare(here, there, table, part, found);
    if (way < 0)
      found.push_back(
          {.part = part, .row = place(here, table), .here = "a row", .there = "no row"});
    if (way > 0)
      lacking.push_back(
          {.part = part, .row = place(there, table), .here = "no row", .there = "a row"});
    if (!found.empty()) each(here, found);
    if (way <= 0) has_ours = here.executeStep();
    if (way >= 0) has_theirs = there.executeStep();
  }
  return lacking;
}

using Key = std::variant<double, std::string>;

Key key_of(const SQLite::Column& key) {
  if (key.isText()) return key.getString();
  return key.getDouble();
}

void bind_key(SQLite::Statement& statement, int place, const Key& value) {
  std::visit([&](const auto& known) { statement.bind(place, known); }, value);
}

void must_be_same(const RowsOfJob& job, const RowsOfJob& other, const Table& table, Part part,
                  SQLite::Statement& theirs) {
  SQLite::Statement ours(job.sqlite(),
                         fmt::format("SELECT {} FROM {} WHERE job_id = :job_id{}",
                                     list(table.columns, "{}"), table.name, all_equal(table.key)));
  ours.bind(":job_id", job.job_id);
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (std::ranges::find(table.key, table.columns[i]) != table.key.end())
      bind_value(ours, ours.getIndex((":" + table.columns[i]).c_str()),
                 theirs.getColumn(static_cast<int>(i)));
  ours.executeStep();
  std::vector<Difference> found;
  compare(ours, theirs, table, part, found);
  for (const Difference& difference : found)
    if (!difference.is_in_last_digits)
      throw Damage(fmt::format(
          "{} and {}: the {} of job {}{} differ in {}: {} here, {} there. One of the two "
          "computations was disturbed, or made by another version of the program; nothing of this "
          "job was changed",
          job.database.path().string(), other.database.path().string(), table.name, job.job_id,
          difference.row.empty() ? "" : ", " + difference.row + ",", difference.column,
          difference.here, difference.there));
}

std::int64_t add(const RowsOfJob& ours, const RowsOfJob& theirs, const Table& table,
                 std::optional<Part> compared) {
  SQLite::Statement from = rows(theirs, table);
  const auto part = grown_part(table.name);
  std::string marks;
  for (std::size_t i = 0; i < table.columns.size(); ++i) marks += ", ?";
  SQLite::Statement insert(
      ours.sqlite(),
      fmt::format(
          "INSERT INTO {0} (job_id, {1}) VALUES (?{2}) ON CONFLICT DO NOTHING RETURNING {1}",
          table.name, list(table.columns, "{}"), marks));
  std::int64_t added = 0;
  while (from.executeStep()) {
    insert.reset();
    insert.bind(1, ours.job_id);
    for (int i = 0; i < from.getColumnCount(); ++i) bind_value(insert, i + 2, from.getColumn(i));
    if (insert.executeStep()) {
      ++added;
      Digests& digests = ours.database.digests();
      if (part) digests.added(ours.job_id, *part, digests.table(*part).digest(insert));
    } else if (compared) {
      must_be_same(ours, theirs, table, *compared, from);
    }
  }
  return added;
}

}  // namespace

double last_digits(std::string_view column) {
  constexpr double logarithm = 1e-9, transform = 1e-6;
  if (column == "gamma_ratio" || column == "tau_c" || column == "time_c") return logarithm;
  if (column == "value" || column == "correlation_trace") return transform;
  return 0;
}

std::string described(const SQLite::Column& value) {
  if (value.isNull()) return "NULL";
  if (value.isFloat()) return fmt::format("{:.17g}", value.getDouble());
  if (value.isBlob()) return fmt::format("a BLOB of {} bytes", value.getBytes());
  return printable(value.getString());
}

void bind_value(SQLite::Statement& statement, int place, const SQLite::Column& value) {
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

std::string list(const std::vector<std::string>& columns, std::string_view form) {
  std::string text;
  for (const std::string& column : columns)
    text += (text.empty() ? "" : ", ") + fmt::format(fmt::runtime(form), column);
  return text;
}

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

std::int64_t add_rows(const RowsOfJob& ours, const RowsOfJob& theirs, const std::string& table) {
  return add(ours, theirs, table_of(ours.sqlite(), table), std::nullopt);
}

std::int64_t add_and_compare_rows(const RowsOfJob& ours, const RowsOfJob& theirs, Part part) {
  return add(ours, theirs, table_of(ours.sqlite(), name(part)), part);
}

void drop_rows(const RowsOfJob& ours, const std::string& table) {
  SQLite::Statement statement(ours.sqlite(), fmt::format("DELETE FROM {} WHERE job_id = ?", table));
  statement.bind(1, ours.job_id);
  statement.exec();
}

const char* chunks_of(Part part) {
  if (part == Part::checkpoints) return "checkpoint_chunks";
  return part == Part::snapshots ? "snapshot_chunks" : nullptr;
}

void drop_differing_rows(const RowsOfJob& ours, const RowsOfJob& theirs, Part part,
                         LastDigits last_digits) {
  const Table table = table_of(ours.sqlite(), name(part));
  std::vector<std::vector<Key>> keys;
  walk(ours, theirs, table, part,
       [&](SQLite::Statement& here, const std::vector<Difference>& found) {
         if (last_digits == LastDigits::may_differ &&
             std::ranges::all_of(found, &Difference::is_in_last_digits))
           return;
         keys.emplace_back();
         for (const std::string& key : table.key)
           keys.back().push_back(key_of(here.getColumn(key.c_str())));
       });
  SQLite::Statement drop(ours.sqlite(), fmt::format("DELETE FROM {} WHERE job_id = :job_id{}",
                                                    table.name, all_equal(table.key)));
  for (const auto& key : keys) {
    drop.reset();
    drop.bind(":job_id", ours.job_id);
    for (std::size_t k = 0; k < key.size(); ++k)
      bind_key(drop, drop.getIndex((":" + table.key[k]).c_str()), key[k]);
    drop.exec();
  }
}

std::vector<Difference> differences(const RowsOfJob& ours, const RowsOfJob& theirs, Part part) {
  const Table table = table_of(ours.sqlite(), name(part));
  std::vector<Difference> all;
  const auto keep = [&](SQLite::Statement&, const std::vector<Difference>& found) {
    all.insert(all.end(), found.begin(), found.end());
  };
  for (const Difference& lacking : walk(ours, theirs, table, part, keep)) all.push_back(lacking);
  return all;
}

}  // namespace haff::schema
