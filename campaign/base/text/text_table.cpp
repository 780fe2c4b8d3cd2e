// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/text/text_table.hpp"

#include <algorithm>

#include "campaign/base/text/printable.hpp"

namespace haff::campaign {
namespace {

// Counts characters, not bytes: continuation bytes of UTF-8 take no room.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t wanted, Align align) {
  const std::string blanks(wanted - std::min(wanted, width(text)), ' ');
  return align == Align::left ? text + blanks : blanks + text;
}

}  // namespace

void TextTable::add(std::vector<std::string> cells) {
  for (std::string& cell : cells) cell = printable(cell);
  rows_.push_back(std::move(cells));
}

std::string TextTable::text() const {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    std::size_t widest = width(columns_[c].title);
    for (const auto& row : rows_) widest = std::max(widest, width(row.at(c)));
    widths.push_back(widest);
  }

  const auto line = [&](const auto& cell) {
    std::string text;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (c > 0) text += "  ";
      text += padded(cell(c), widths[c], columns_[c].align);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text + '\n';
  };

  std::string table = line([&](std::size_t c) { return columns_[c].title; });
  table += line([&](std::size_t c) { return std::string(widths[c], '-'); });
  for (const auto& row : rows_) table += line([&](std::size_t c) { return row[c]; });
  return table;
}

}  // namespace haff::campaign
