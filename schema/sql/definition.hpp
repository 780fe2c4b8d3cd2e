// SPDX-License-Identifier: GPL-3.0-or-later

// What a store is defined by: the SQL of its tables, indexes and views. Private to schema/.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <map>
#include <span>
#include <string>
#include <string_view>

namespace haff::schema {

struct Object {
  std::string type;   // table, virtual table, index, view or trigger
  std::string table;  // the table that it belongs to
  std::string sql;    // empty for the index that a PRIMARY KEY or UNIQUE makes

  bool operator==(const Object&) const = default;
};

using Definition = std::map<std::string, Object>;  // by name

Definition definition_of(SQLite::Database& sqlite);

// What these scripts make of an empty store. All of them take some 8 ms.
Definition definition_made_by(std::span<const std::string_view> scripts);

// The definition as one text: equal texts are equal definitions.
std::string in_one_text(const Definition& definition);

// The text of what all scripts make, as it was when the program was built
// (write_newest_definition.cpp).
std::string_view newest_definition();

}  // namespace haff::schema
