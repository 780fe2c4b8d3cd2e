// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/sql/definition.hpp"

namespace haff::schema {

Definition definition_of(SQLite::Database& sqlite) {
  // A table without pages of its own is a virtual one.
  SQLite::Statement row(sqlite, R"(
    SELECT name, iif(type = 'table' AND rootpage = 0, 'virtual table', type), tbl_name,
           coalesce(sql, '')
    FROM sqlite_schema)");
  Definition definition;
  while (row.executeStep())
    definition[row.getColumn(0).getString()] = {.type = row.getColumn(1).getString(),
                                                .table = row.getColumn(2).getString(),
                                                .sql = row.getColumn(3).getString()};
  return definition;
}

Definition definition_made_by(std::span<const std::string_view> scripts) {
  SQLite::Database sqlite(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  for (const std::string_view script : scripts) sqlite.exec(std::string(script));
  return definition_of(sqlite);
}

// Each word is preceded by its length, so that no word can pass for two.
std::string in_one_text(const Definition& definition) {
  std::string text;
  for (const auto& [name, object] : definition)
    for (const std::string* word : {&object.type, &name, &object.table, &object.sql})
      text += std::to_string(word->size()) + ' ' + *word + '\n';
  return text;
}

}  // namespace haff::schema
