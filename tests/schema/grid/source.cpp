// SPDX-License-Identifier: GPL-3.0-or-later

// A grid as a file and as JSON: errors are shown with their place.
#include "schema/grid/source.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "schema/fixture.hpp"
#include "schema/grid/complaint.hpp"

using namespace haff::schema;

TEST_CASE("a file is read, and named when it cannot be read") {
  const TemporaryFolder folder;
  std::ofstream(folder / "g.json") << with("e", "0.9");
  CHECK(read_grid(folder / "g.json", machine).grids[0].e == std::vector{0.9});
  CHECK_THROWS_WITH_AS(
      read_grid(folder / "h.json", machine),
      ((folder / "h.json").string() + ": cannot be read: No such file or directory").c_str(),
      GridError);
  CHECK_THROWS_WITH_AS(read_grid(folder / "", machine),
                       ((folder / "").string() + ": cannot be read: Is a directory").c_str(),
                       GridError);
}

TEST_CASE("an error in JSON is shown with its line and column") {
  check_complaint("",
                  "g.json: is not JSON: line 1, column 1: syntax error while parsing value - "
                  "unexpected end of input; expected '[', '{', or a literal");
  check_complaint("{\n  \"e\": 0.8,\n  n: 0.4}",
                  "g.json: is not JSON: line 3, column 4: syntax error while parsing object key - "
                  "invalid literal; last read: '0.8,<U+000A>  n:'; expected string literal");
  check_complaint("{\"e\": NaN}",
                  "g.json: is not JSON: line 1, column 7: syntax error while parsing value - "
                  "invalid literal; last read: '\"e\": N'");
  check_complaint("{\"e\": 0.8",
                  "g.json: is not JSON: line 1, column 10: syntax error while parsing object - "
                  "unexpected end of input; expected '}'");
  check_complaint("{\"e\": 0.8} {}",
                  "g.json: is not JSON: line 1, column 12: syntax error while parsing value - "
                  "unexpected '{'; expected end of input");
  check_complaint("{\"e\": \"\xff\"}",
                  "g.json: is not JSON: line 1, column 8: syntax error while parsing value - "
                  "invalid string: ill-formed UTF-8 byte; last read: '\"\xff'");
}

TEST_CASE("a repeated key is named with its place") {
  check_complaint(R"({"e": 0.8, "e": 0.9})",
                  "g.json: /e: the key is there twice; expected each key once");
  check_complaint(R"({"grids": [{"e": 0.8}, {"N": 10, "N": 10}]})",
                  "g.json: /grids/1/N: the key is there twice; expected each key once");
  check_complaint(R"({"tau_max": {"0.8": 1, "0.8": 2}})",
                  "g.json: /tau_max/0.8: the key is there twice; expected each key once");
}

TEST_CASE("a number that no double holds is named with its place") {
  check_complaint(with("tau_max", "1e999"),
                  "g.json: /tau_max: 1e999 is too large; expected a finite number");
  check_complaint(R"({"grids": [{"e": [0.8, -1e999]}]})",
                  "g.json: /grids/0/e/1: -1e999 is too large; expected a finite number");
}

TEST_CASE("nesting beyond reason is refused") {
  CHECK(complaint(with("e", std::string(100000, '[')))
            .ends_with("/0/0: is nested too deeply; expected a grid"));
}

TEST_CASE("$schema and keys that begin with _ are for editors and notes") {
  const Grid grid = parse(R"({"$schema": "grid.schema.json", "_note": {"by": ["me"]}, "e": 0.8,
                              "n": 0.4, "N": 1000, "seeds": 1, "tau_max": {"0.8": 90, "_": "long"},
                              "grids": [{"_why": 3}]})");
  CHECK(grid.grids[0].tau_max == std::vector{90.0});
  check_complaint(with("$schem", "1"),
                  "g.json: /$schem: unknown key; expected one of \"N\", \"checkpoint_every\", "
                  "\"d\", \"e\", \"effects\", \"equilibrate\", \"fields_at\", \"grids\", \"n\", "
                  "\"name\", \"observables\", \"profiles_every\", \"sample_at\", \"sample_every\", "
                  "\"seeds\", \"snapshots_at\", \"start\", \"target\", \"tau_max\"");
}

TEST_CASE("a number too small for a double is refused") {
  check_complaint(with("n", "1e-400"),
                  "g.json: /n: 1e-400 is too small; expected 0 or a number that a double holds");
  CHECK(parse(with("e", "0e-400")).grids[0].e == std::vector{0.0});
}

// ---- bounds -----------------------------------------------------------------------------------
