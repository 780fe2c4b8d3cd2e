// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/suggestion.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

namespace haff::schema {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string quoted(const std::string& word) {
  return '"' + word + '"';
}

}  // namespace

std::size_t distance(const std::string& one, const std::string& other) {
  const std::string a = lower(one), b = lower(other);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  const auto nearest = std::min_element(known.begin(), known.end(), [&](auto& a, auto& b) {
    return distance(word, a) < distance(word, b);
  });
  if (2 * distance(word, *nearest) <= word.size()) return "did you mean " + quoted(*nearest) + "?";
  std::string all = "expected one of ";
  for (const std::string& one : known) all += (&one == &known.front() ? "" : ", ") + quoted(one);
  return all;
}

}  // namespace haff::schema
