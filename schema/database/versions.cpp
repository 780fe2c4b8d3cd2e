// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/database/versions.hpp"

#include <map>
#include <string>
#include <tuple>

#include "schema/database/views.hpp"
#include "schema/embedded.hpp"
#include "schema/error.hpp"

namespace haff::schema {

namespace {

int number(SQLite::Database& sqlite, const char* sql) {
  return sqlite.execAndGet(sql).getInt();
}

// What an object of a schema is: type, the table it belongs to, its SQL.
using Object = std::tuple<std::string, std::string, std::string>;
using Schema = std::map<std::string, Object>;  // by name

Schema schema_of(SQLite::Database& sqlite) {
  // A table without pages of its own is a virtual one.
  SQLite::Statement row(sqlite, R"(
    SELECT name, iif(type = 'table' AND rootpage = 0, 'virtual table', type), tbl_name,
           coalesce(sql, '')
    FROM sqlite_schema)");
  Schema schema;
  while (row.executeStep())
    schema[row.getColumn(0).getString()] = {
        row.getColumn(1).getString(), row.getColumn(2).getString(), row.getColumn(3).getString()};
  return schema;
}

Schema schema_made_by(std::span<const std::string_view> scripts) {
  SQLite::Database sqlite(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  for (const std::string_view script : scripts) sqlite.exec(std::string(script));
  return schema_of(sqlite);
}

// What a store of this version is made of. To run all scripts takes some 8 ms, so that the newest
// version, which nearly every store is of, is made once.
Schema expected_schema(int version) {
  const auto known = scripts();
  const auto seen = static_cast<std::size_t>(version);
  if (seen < known.size()) return schema_made_by(std::span(known).first(seen));
  static const Schema newest = schema_made_by(known);
  return newest;
}

bool acts_by_itself(const Object& object) {
  const auto& [type, table, sql] = object;
  // An index without SQL is that of a user's own PRIMARY KEY or UNIQUE.
  return type == "trigger" || type == "virtual table" || (type == "index" && !sql.empty());
}

}  // namespace

std::vector<std::string_view> scripts() {
  std::vector<std::string_view> texts;
  for (const Embedded& file : embedded())
    if (file.name.ends_with(".sql")) texts.push_back(file.text);
  static const std::string last_and_views = std::string(texts.back()) + mean_views_script();
  texts.back() = last_and_views;
  return texts;
}

int version_with(std::string_view script) {
  int version = 0;
  for (const Embedded& file : embedded()) {
    if (file.name.ends_with(".sql")) ++version;
    if (file.name == script) break;
  }
  return version;
}

int version_of(SQLite::Database& sqlite) {
  return number(sqlite, "PRAGMA user_version");
}

bool is_empty(SQLite::Database& sqlite) {
  return number(sqlite, "SELECT count(*) FROM sqlite_schema") == 0 && version_of(sqlite) == 0 &&
         number(sqlite, "PRAGMA application_id") == 0;
}

void must_be_store(SQLite::Database& sqlite, const std::filesystem::path& name) {
  if (number(sqlite, "PRAGMA application_id") != application_id)
    throw NameError(name.string() + ": is the SQLite file of another program",
                    Remedy::name_a_store);
}

void must_not_be_newer(int version, std::size_t known, const std::filesystem::path& name) {
  if (version > static_cast<int>(known))
    throw StoreError(name.string() + ": was written by a newer program (store version " +
                     std::to_string(version) + ", this one knows " + std::to_string(known) +
                     "); update campaign");
}

void must_have_our_schema(SQLite::Database& sqlite, int version,
                          const std::filesystem::path& name) {
  const Schema expected = expected_schema(version);
  const Schema found = schema_of(sqlite);
  const auto refuse = [&](const std::string& what) {
    throw Damage(name.string() + ": " + what +
                 "; it was changed by another program, or damaged, and is not used. Restore a "
                 "backup");
  };
  for (const auto& [object, definition] : expected)
    if (const auto there = found.find(object); there == found.end())
      refuse("its " + std::get<0>(definition) + " " + object + " is gone");
    else if (there->second != definition)
      refuse("its " + std::get<0>(definition) + " " + object + " is not as this program makes it");
  for (const auto& [object, definition] : found)
    if (!expected.contains(object) && acts_by_itself(definition))
      refuse("the " + std::get<0>(definition) + " " + object +
             " in it is not of this program's making");
}

void migrate(SQLite::Database& sqlite, const std::filesystem::path& name,
             std::span<const std::string_view> scripts, const std::function<void()>& afterwards) {
  if (version_of(sqlite) == static_cast<int>(scripts.size())) return;
  SQLite::Transaction transaction(sqlite, SQLite::TransactionBehavior::IMMEDIATE);
  const int from = version_of(sqlite);  // again: another process may just have done it
  must_not_be_newer(from, scripts.size(), name);
  for (std::size_t i = static_cast<std::size_t>(from); i < scripts.size(); ++i)
    sqlite.exec(std::string(scripts[i]));
  sqlite.exec("PRAGMA application_id = " + std::to_string(application_id));
  sqlite.exec("PRAGMA user_version = " + std::to_string(scripts.size()));
  if (afterwards) afterwards();
  transaction.commit();
}

}  // namespace haff::schema
