// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/database/versions.hpp"

#include <string>

#include "schema/error.hpp"
#include "schema/sql/definition.hpp"

namespace haff::schema {

namespace {

int number(SQLite::Database& sqlite, const char* sql) {
  return sqlite.execAndGet(sql).getInt();
}

bool acts_by_itself(const Object& object) {
  // An index without SQL is that of a user's own PRIMARY KEY or UNIQUE.
  return object.type == "trigger" || object.type == "virtual table" ||
         (object.type == "index" && !object.sql.empty());
}

}  // namespace

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
  const Definition found = definition_of(sqlite);
  const auto known = scripts();
  const auto seen = static_cast<std::size_t>(version);
  if (seen == known.size() && in_one_text(found) == newest_definition()) return;
  // The store is of an older version, has tables that a user has added, or is not ours.
  const Definition expected = definition_made_by(std::span(known).first(seen));
  const auto refuse = [&](const std::string& what) {
    throw Damage(name.string() + ": " + what +
                 "; it was changed by another program, or damaged, and is not used. Restore a "
                 "backup");
  };
  for (const auto& [object, definition] : expected)
    if (const auto there = found.find(object); there == found.end())
      refuse("its " + definition.type + " " + object + " is gone");
    else if (there->second != definition)
      refuse("its " + definition.type + " " + object + " is not as this program makes it");
  for (const auto& [object, definition] : found)
    if (!expected.contains(object) && acts_by_itself(definition))
      refuse("the " + definition.type + " " + object + " in it is not of this program's making");
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
