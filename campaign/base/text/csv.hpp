// SPDX-License-Identifier: GPL-3.0-or-later

// Comma-separated values by RFC 4180, except that lines end with a line feed alone, as Unix tools
// expect; every reader of CSV takes both.
//
//   csv_row("tau_c", 0.8, std::optional<double>(), "a, b")  ->  tau_c,0.8...,,"a, b"
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace haff::campaign {

// One field each. Reals have 17 digits, which read back as the same bits; a value that is not
// finite, and an optional without a value, is an empty field. Text is quoted where it holds a
// comma, a quote or an end of line, or where it is empty, to tell it from no value.
std::string csv_field(double value);
std::string csv_field(std::string_view text);
inline std::string csv_field(const std::string& text) {
  return csv_field(std::string_view(text));
}
inline std::string csv_field(const char* text) {
  return csv_field(std::string_view(text));
}
template <std::integral T>
std::string csv_field(T value) {
  return std::to_string(value);
}
template <class T>
std::string csv_field(const std::optional<T>& value) {
  return value ? csv_field(*value) : std::string();
}

// A line of fields that are fields already.
std::string csv_line(const std::vector<std::string>& fields);

// A line of values.
template <class... Values>
std::string csv_row(const Values&... values) {
  return csv_line({csv_field(values)...});
}

}  // namespace haff::campaign
