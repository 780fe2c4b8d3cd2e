// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/database/prepared.hpp"

#include <sqlite3.h>

#include <exception>
#include <utility>

#include "schema/database/database.hpp"

namespace haff::schema {

SQLite::Statement PreparedStatements::take(const std::string& sql) {
  const auto found = kept_.find(sql);
  if (found == kept_.end()) return {sqlite_, sql};
  SQLite::Statement statement = std::move(found->second);
  kept_.erase(found);
  return statement;
}

void PreparedStatements::give_back(SQLite::Statement&& statement) noexcept try {
  statement.tryReset();  // lets go of the store; an error was reported when it occurred
  statement.clearBindings();
  std::string sql = statement.getQuery();
  kept_.try_emplace(std::move(sql), std::move(statement));
} catch (const std::exception&) {  // without memory it is compiled again the next time
}

Prepared::Prepared(Database& database, const std::string& sql)
    : SQLite::Statement(database.statements().take(sql)), statements_(database.statements()) {}

Prepared::~Prepared() {
  statements_.give_back(std::move(*this));
}

}  // namespace haff::schema
