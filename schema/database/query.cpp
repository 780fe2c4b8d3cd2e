// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/database/query.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include "schema/database/database.hpp"

namespace haff::schema {

namespace {

struct Finalize {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Compiled = std::unique_ptr<sqlite3_stmt, Finalize>;

// SQLite compiles the first statement of a text and leaves the rest alone, so that two statements
// are refused: the user would believe that both were run. Nor does every statement that writes
// write to the store (VACUUM INTO).
void must_be_one_that_reads(sqlite3* handle, const std::string& sql) {
  const auto compile = [&](const char* text, const char** rest) {
    sqlite3_stmt* statement = nullptr;
    if (const int result = sqlite3_prepare_v2(handle, text, -1, &statement, rest);
        result != SQLITE_OK)
      throw SQLite::Exception(handle, result);
    return Compiled(statement);
  };
  const char* rest = nullptr;
  const auto statement = compile(sql.c_str(), &rest);
  if (!statement) throw QueryError("SQL: there is no statement");
  if (!sqlite3_stmt_readonly(statement.get()))
    throw QueryError("SQL: this statement would write; a query only reads: " + sql);
  if (compile(rest, nullptr))
    throw QueryError("SQL: one statement at a time; not expected: " + std::string(rest));
}

// The text that the user typed is to blame, unless the store or the system is.
[[noreturn]] void blame(Database& database, const SQLite::Exception& error) {
  switch (error.getErrorCode() & 0xff) {  // without SQLite's extension of the code
    case SQLITE_ERROR:
    case SQLITE_AUTH:
    case SQLITE_READONLY:
    case SQLITE_TOOBIG:
    case SQLITE_CONSTRAINT:
    case SQLITE_MISMATCH:
    case SQLITE_RANGE:
    case SQLITE_MISUSE:
      throw QueryError(std::string("SQL: ") + error.what());
    default:
      raise(database.path(), error);
  }
}

Value value(const SQLite::Column& column) {
  if (column.isNull()) return Null{};
  if (column.isInteger()) return column.getInt64();
  if (column.isFloat()) return column.getDouble();
  if (column.isText()) return column.getString();
  const auto* bytes = static_cast<const std::byte*>(column.getBlob());
  return Blob(bytes, bytes + column.getBytes());
}

}  // namespace

struct Query::Cursor {
  Database& database;
  SQLite::Statement statement;
  std::vector<std::string> columns;

  Cursor(Database& of, const std::string& sql) : database(of), statement(of.sqlite(), sql) {
    for (int i = 0; i < statement.getColumnCount(); ++i)
      columns.emplace_back(statement.getColumnName(i));
  }
};

Query::Query(Database& database, const std::string& sql) try {
  must_be_one_that_reads(database.sqlite().getHandle(), sql);
  cursor_ = std::make_unique<Cursor>(database, sql);
} catch (const SQLite::Exception& error) {
  blame(database, error);
}

Query::~Query() = default;
Query::Query(Query&&) noexcept = default;
Query& Query::operator=(Query&&) noexcept = default;

const std::vector<std::string>& Query::columns() const {
  return cursor_->columns;
}

std::optional<Row> Query::next() try {
  if (cursor_->statement.isDone() || !cursor_->statement.executeStep()) return std::nullopt;
  Row row;
  for (int i = 0; i < cursor_->statement.getColumnCount(); ++i)
    row.push_back(value(cursor_->statement.getColumn(i)));
  return row;
} catch (const SQLite::Exception& error) {
  blame(cursor_->database, error);
}

}  // namespace haff::schema
