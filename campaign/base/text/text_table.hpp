// SPDX-License-Identifier: GPL-3.0-or-later

// Aligned tables for people: a head, rows, and columns as wide as their text.
#pragma once

#include <string>
#include <vector>

namespace haff::campaign {

enum class Align { left, right };

class TextTable {
 public:
  struct Column {
    std::string title;
    Align align = Align::right;
  };

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

  // As many cells as there are columns. They may hold text of a store: each is made printable.
  void add(std::vector<std::string> cells);
  bool empty() const { return rows_.empty(); }

  std::string text() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

// The text in place of a value that a table does not have.
inline constexpr const char* no_value = "-";

}  // namespace haff::campaign
