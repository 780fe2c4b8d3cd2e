// SPDX-License-Identifier: GPL-3.0-or-later

// A user's SQL statement and its rows, one after another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace haff::schema {

using Null = std::monostate;
using Blob = std::vector<std::byte>;
using Value = std::variant<Null, std::int64_t, double, std::string, Blob>;
using Row = std::vector<Value>;

class Database;

class Query {
 public:
  ~Query();
  Query(Query&&) noexcept;
  Query& operator=(Query&&) noexcept;

  const std::vector<std::string>& columns() const;

  // The next row, one value a column; nothing after the last. Throws QueryError.
  std::optional<Row> next();

 private:
  friend class Reader;
  Query(Database& database, const std::string& sql);

  struct Cursor;
  std::unique_ptr<Cursor> cursor_;
};

}  // namespace haff::schema
