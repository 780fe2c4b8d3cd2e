// SPDX-License-Identifier: GPL-3.0-or-later

// Statements that a connection keeps compiled: SQLite takes longer to compile a small statement
// than to carry it out, and a job needs some forty, the same for each. Private to schema/.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>
#include <unordered_map>

namespace haff::schema {

class Database;

class PreparedStatements {
 public:
  explicit PreparedStatements(SQLite::Database& sqlite) : sqlite_(sqlite) {}
  // The statement of this text, out of those that are kept, or compiled now.
  SQLite::Statement take(const std::string& sql);
  void give_back(SQLite::Statement&& statement) noexcept;

 private:
  SQLite::Database& sqlite_;
  std::unordered_map<std::string, SQLite::Statement> kept_;
};

// A statement of a store's connection, used like any other, which goes back to those that are kept,
// without its values, when this object ends.
class Prepared : public SQLite::Statement {
 public:
  Prepared(Database& database, const std::string& sql);
  ~Prepared();
  Prepared(const Prepared&) = delete;
  Prepared& operator=(const Prepared&) = delete;

 private:
  PreparedStatements& statements_;
};

}  // namespace haff::schema
