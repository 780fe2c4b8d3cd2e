// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/database/sql_names.hpp"

#include <algorithm>
#include <cctype>

namespace haff::schema {

namespace {

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool is_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
}

// The place after the text in quotes that begins at `begin`.
std::size_t end_of_quote(std::string_view sql, std::size_t begin) {
  const auto close = sql.find(sql[begin], begin + 1);
  return close == std::string_view::npos ? sql.size() : close + 1;
}

// The place after the number that begins at `begin`: 1e-4 is one number.
std::size_t end_of_number(std::string_view sql, std::size_t begin) {
  const auto is_sign_of_exponent = [&](std::size_t i) {
    return (sql[i] == '-' || sql[i] == '+') && (sql[i - 1] == 'e' || sql[i - 1] == 'E');
  };
  std::size_t end = begin + 1;
  while (end < sql.size() && (is_letter(sql[end]) || is_sign_of_exponent(end))) ++end;
  return end;
}

std::size_t end_of_word(std::string_view sql, std::size_t begin) {
  std::size_t end = begin + 1;
  while (end < sql.size() && is_letter(sql[end])) ++end;
  return end;
}

bool is_function(std::string_view sql, std::size_t end) {
  const auto next = sql.find_first_not_of(' ', end);
  return next != std::string_view::npos && sql[next] == '(';
}

}  // namespace

std::string with_names(std::string_view sql,
                       const std::function<std::string(std::string_view)>& replacement) {
  std::string result;
  for (std::size_t i = 0; i < sql.size();) {
    const char c = sql[i];
    const bool begins_number =
        is_digit(c) || (c == '.' && i + 1 < sql.size() && is_digit(sql[i + 1]));
    std::size_t end = i + 1;
    bool is_name = false;
    if (c == '\'' || c == '"') {
      end = end_of_quote(sql, i);
    } else if (begins_number) {
      end = end_of_number(sql, i);
    } else if (is_letter(c)) {
      end = end_of_word(sql, i);
      is_name = !is_function(sql, end);
    }
    const std::string_view text = sql.substr(i, end - i);
    result += is_name ? replacement(text) : std::string(text);
    i = end;
  }
  return result;
}

std::vector<std::string> names_in(std::string_view sql) {
  std::vector<std::string> names;
  with_names(sql, [&](std::string_view name) {
    names.emplace_back(name);
    return std::string();
  });
  return names;
}

}  // namespace haff::schema
