#include "schema/query.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include "schema/database.hpp"

namespace haff::schema {

namespace {

struct Finalize {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Compiled = std::unique_ptr<sqlite3_stmt, Finalize>;

// SQLite compiles the first statement of a text and leaves the rest alone: a user who typed two
// must not believe that both were run. And not all that writes writes to the store (VACUUM INTO).
void must_be_one_that_reads(sqlite3* handle, const std::string& sql) {
  const auto compile = [&](const char* text, const char** rest) {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(handle, text, -1, &statement, rest) != SQLITE_OK)
      throw QueryError(std::string("SQL: ") + sqlite3_errmsg(handle));
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
  SQLite::Statement statement;
  std::vector<std::string> columns;

  Cursor(SQLite::Database& sqlite, const std::string& sql) : statement(sqlite, sql) {
    for (int i = 0; i < statement.getColumnCount(); ++i)
      columns.emplace_back(statement.getColumnName(i));
  }
};

Query::Query(Database& database, const std::string& sql) try {
  must_be_one_that_reads(database.sqlite().getHandle(), sql);
  cursor_ = std::make_unique<Cursor>(database.sqlite(), sql);
} catch (const SQLite::Exception& error) {
  throw QueryError(std::string("SQL: ") + error.what());
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
  throw QueryError(std::string("SQL: ") + error.what());
}

}  // namespace haff::schema
