// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/state/extended_xyz.hpp"

#include <doctest/doctest.h>

#include <sstream>
#include <string>
#include <vector>

#include "engine/initial.hpp"
#include "engine/simulation.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

std::vector<std::string> lines_of(const engine::State& state, const std::string& facts) {
  std::ostringstream out;
  write_xyz(state, facts, out);
  std::istringstream in(out.str());
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("extended XYZ: a header with cell, periodicity and columns, then particles by id") {
  engine::State state;
  state.box = 4;
  state.id = {1, 0};
  state.position = {{1, 2, 3}, {0, 0.1 + 0.2, 3.5}};
  state.velocity = {{1, 0, 0}, {-2, 0, 0.5}};
  state.exponent = 1;  // true velocities are half of these
  CHECK(lines_of(state, "tau=3") ==
        std::vector<std::string>{
            "2",
            R"(Lattice="4 0 0 0 4 0 0 0 4" Origin="0 0 0" pbc="T T T" )"
            "Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1:mass:R:1:id:I:1 tau=3",
            "H 0 0.30000000000000004 3.5 -1 0 0.25 0.5 1 0", "H 1 2 3 0.5 0 0 0.5 1 1"});
}

TEST_CASE(
    "extended XYZ: disks lie in a layer, species have names, and rough particles have spins") {
  engine::State state = engine::initial_state(
      0.3, 10, 1, 2,
      {{"mixture", {{"fraction", 0.5}, {"diameter_ratio", 0.8}, {"mass_ratio", 0.1}}}});
  std::vector<double> spin(30);
  spin[29] = 7;  // the surface speed of a disk of radius 0.4
  state.memory["spin"] = spin;
  const auto lines = lines_of(state, "n=0.3");
  REQUIRE(lines.size() == 12);
  CHECK(lines[1].find(R"( 0 0 0 1" Origin="0 0 -0.5" pbc="T T F")") != std::string::npos);
  CHECK(lines[1].find(":id:I:1:omega:R:3 n=0.3") != std::string::npos);
  CHECK(lines[2].starts_with("H "));
  CHECK(lines[11].starts_with("He "));
  CHECK(lines[11].ends_with(" 0.4 0.1 9 0 0 17.5"));
}

TEST_CASE("extended XYZ: text in the header is in quotes") {
  CHECK(quoted_for_xyz(R"({"a":1})") == R"('{"a":1}')");
  CHECK(quoted_for_xyz("{}") == R"("{}")");
  CHECK_THROWS_AS(quoted_for_xyz(R"(it's "a")"), std::invalid_argument);
}
