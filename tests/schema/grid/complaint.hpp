// SPDX-License-Identifier: GPL-3.0-or-later

// The grids of the tests of schema/grid, and the messages about them.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "schema/grid/grid.hpp"

namespace haff::schema {

inline constexpr Memory machine{.bytes = 8e9, .bytes_per_particle = 200};

inline Grid parse(const std::string& text) {
  return parse_grid(text, "g.json", machine);
}

// A complete flat grid, with one more member in front or instead of one of its own.
inline std::string with(const std::string& key, const std::string& value) {
  std::string text;
  for (const auto& [own, usual] : std::vector<std::pair<std::string, std::string>>{
           {"e", "0.8"}, {"n", "0.4"}, {"N", "1000"}, {"seeds", "1"}, {"tau_max", "90"}})
    if (own != key) text.append("\"").append(own).append("\": ").append(usual).append(", ");
  return "{" + text + '"' + key + "\": " + value + "}";
}

// A complete grid with this target.
inline std::string with_target(const std::string& target,
                               const std::string& rest = R"("seeds": 5)") {
  return R"({"e": 0.8, "n": 0.4, "N": 1000, "tau_max": 90, )" + rest + R"(, "target": )" + target +
         "}";
}

// The message about what is wrong with a grid.
inline std::string complaint(const std::string& text) {
  try {
    parse(text);
  } catch (const GridError& error) {
    return error.what();
  }
  return "no complaint";
}

inline void check_complaint(const std::string& text, const std::string& message) {
  CAPTURE(text);
  CHECK(complaint(text) == message);
}

}  // namespace haff::schema
