// SPDX-License-Identifier: GPL-3.0-or-later

// What the statements of schema/store share. Private to schema/.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <string>

namespace haff::schema {

// SQL: this moment in UTC, ISO 8601.
inline const std::string now = "strftime('%Y-%m-%dT%H:%M:%fZ', 'now')";

// NULL if there is no value.
inline void bind_optional(SQLite::Statement& statement, const char* name,
                          std::optional<double> value) {
  if (value)
    statement.bind(name, *value);
  else
    statement.bind(name);
}

}  // namespace haff::schema
