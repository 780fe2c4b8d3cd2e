// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/rows/column.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace haff::schema {

namespace {

// Bytes of the character that begins here, or 0 if none does that may be printed.
std::size_t printable_bytes(std::string_view text) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const std::size_t size = first >= 0xc2 && first < 0xe0   ? 2
                           : first >= 0xe0 && first < 0xf0 ? 3
                           : first >= 0xf0 && first < 0xf5 ? 4
                                                           : 0;
  if (size == 0 || text.size() < size) return 0;
  std::uint32_t code = first & (0xff >> (size + 1));
  for (std::size_t k = 1; k < size; ++k) {
    if ((byte(k) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(k) & 0x3f);
  }
  const bool is_control = code < 0xa0 || code == 0x2028 || code == 0x2029;
  const bool turns_direction =
      (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  const bool is_overlong = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
  const bool is_surrogate = code >= 0xd800 && code < 0xe000;
  return is_control || turns_direction || is_overlong || is_surrogate || code > 0x10ffff ? 0 : size;
}

[[noreturn]] void refuse(const char* column, const std::string& expected) {
  throw BadValue(std::string("the column ") + column +
                 " holds a value that campaign does not write (" + expected + " expected)");
}

}  // namespace

bool is_printable(std::string_view text) {
  while (!text.empty()) {
    const std::size_t size = printable_bytes(text);
    if (size == 0) return false;
    text.remove_prefix(size);
  }
  return true;
}

std::string printable(std::string text) {
  for (std::size_t k = 0; k < text.size();) {
    const std::size_t size = printable_bytes(std::string_view(text).substr(k));
    if (size == 0) text[k] = ' ';
    k += std::max<std::size_t>(size, 1);
  }
  return text;
}

std::int64_t integer(const SQLite::Statement& row, const char* column, std::int64_t least,
                     std::int64_t most) {
  const auto value = row.getColumn(column);
  if (!value.isInteger()) refuse(column, "a whole number");
  const std::int64_t number = value.getInt64();
  if (number < least || number > most)
    refuse(column, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return number;
}

double real(const SQLite::Statement& row, const char* column) {
  const auto value = row.getColumn(column);
  if (!value.isFloat() && !value.isInteger()) refuse(column, "a number");
  const double number = value.getDouble();
  if (!std::isfinite(number)) refuse(column, "a finite number");
  return number;
}

double not_negative(const SQLite::Statement& row, const char* column) {
  const double number = real(row, column);
  if (number < 0) refuse(column, "a number of at least 0");
  return number;
}

double positive(const SQLite::Statement& row, const char* column) {
  const double number = real(row, column);
  if (number <= 0) refuse(column, "a number above 0");
  return number;
}

std::string text(const SQLite::Statement& row, const char* column) {
  const auto value = row.getColumn(column);
  if (!value.isText()) refuse(column, "a text");
  std::string text = value.getString();
  if (!is_printable(text)) refuse(column, "a text without control characters");
  return text;
}

std::string timestamp(const SQLite::Statement& row, const char* column) {
  constexpr std::string_view form = "0000-00-00T00:00:00.000Z";
  std::string when = text(row, column);
  const bool fits =
      when.size() == form.size() &&
      std::equal(form.begin(), form.end(), when.begin(), [](char expected, char found) {
        return expected == '0' ? found >= '0' && found <= '9' : found == expected;
      });
  if (!fits) refuse(column, "a time like 2003-09-05T12:00:00.000Z");
  return when;
}

}  // namespace haff::schema
