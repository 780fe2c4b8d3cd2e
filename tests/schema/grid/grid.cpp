// SPDX-License-Identifier: GPL-3.0-or-later

// A grid file becomes lists with every default filled in.
#include "schema/grid/grid.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <string>

#include "schema/grid/complaint.hpp"

using namespace haff::schema;

TEST_CASE("a grid with defaults beside it is made explicit") {
  const Grid grid = parse(R"({
    "name": "first",
    "grids": [{"e": [0.80, 0.90], "n": 0.4, "N": 32000, "seeds": [1, 2],
               "tau_max": {"0.80": 90, "0.90": 180}, "sample_every": 1}],
    "equilibrate": 50, "checkpoint_every": 10, "observables": ["temperature", "laguerre"]})");
  CHECK(grid.name == "first");
  REQUIRE(grid.grids.size() == 1);
  const SubGrid& only = grid.grids[0];
  CHECK(only.e == std::vector{0.8, 0.9});
  CHECK(only.n == std::vector{0.4});
  CHECK(only.particles == std::vector<std::uint32_t>{32000});
  CHECK(only.seeds == std::vector<std::uint64_t>{1, 2});
  CHECK(only.tau_max == std::vector{90.0, 180.0});
  CHECK(only.sample_every == std::vector{1.0});
  CHECK(only.equilibrate == std::vector{50.0});
  CHECK(only.checkpoint_every == 10);
  CHECK(only.observables == std::vector<std::string>{"laguerre", "temperature"});
}

TEST_CASE("a flat object is one grid with the schema's defaults") {
  const Grid grid = parse(R"({"e": 0.8, "n": 0.4, "N": 100, "seeds": 3, "tau_max": 90})");
  REQUIRE(grid.grids.size() == 1);
  const SubGrid& only = grid.grids[0];
  CHECK(only.seeds == std::vector<std::uint64_t>{1, 2, 3});
  CHECK(only.tau_max == std::vector{90.0});
  CHECK(only.sample_every == std::vector{1.0});
  CHECK(only.equilibrate == std::vector{50.0});
  CHECK(only.checkpoint_every == 10);
  CHECK(only.observables == std::vector<std::string>{"laguerre", "temperature"});
}

TEST_CASE("a grid's own keys take precedence over those beside it") {
  const Grid grid = parse(R"({"e": 0.8, "n": 0.4, "N": 100, "seeds": 1, "tau_max": 90,
                              "grids": [{}, {"e": [0.9], "seeds": [7], "tau_max": 5}]})");
  REQUIRE(grid.grids.size() == 2);
  CHECK(grid.grids[0].e == std::vector{0.8});
  CHECK(grid.grids[1].e == std::vector{0.9});
  CHECK(grid.grids[1].seeds == std::vector<std::uint64_t>{7});
  CHECK(grid.grids[1].tau_max == std::vector{5.0});
  CHECK(grid.grids[1].n == std::vector{0.4});
}

TEST_CASE("whole numbers may be written as reals") {
  const Grid grid = parse(with("N", "[32000.0, 6.4e4]"));
  CHECK(grid.grids[0].particles == std::vector<std::uint32_t>{32000, 64000});
}

TEST_CASE("the largest seed keeps all its digits") {
  const Grid grid = parse(with("seeds", "[0, 9007199254740991]"));
  CHECK(grid.grids[0].seeds == std::vector<std::uint64_t>{0, 9007199254740991});
}

TEST_CASE("a scalar stands for a list of one value") {
  const Grid grid = parse(with("observables", "\"temperature\""));
  CHECK(grid.grids[0].observables == std::vector<std::string>{"temperature"});
  CHECK(parse(with("sample_every", "2")).grids[0].sample_every == std::vector{2.0});
  CHECK(parse(with("sample_every", "[2, 4]")).grids[0].sample_every == std::vector{2.0, 4.0});
}

TEST_CASE("tau_max is matched to e by value, in the order of e") {
  const Grid grid = parse(R"({"e": [0.9, 0.8, 0.85], "n": 0.4, "N": 100, "seeds": 1,
                              "tau_max": {"0.80": 1, "0.850": 2, "9e-1": 3}})");
  CHECK(grid.grids[0].tau_max == std::vector{3.0, 1.0, 2.0});
}

TEST_CASE("a tau_max map beside several grids gives each grid its own e") {
  const Grid grid = parse(R"({"n": 0.4, "N": 100, "seeds": 1, "tau_max": {"0.8": 1, "0.9": 2},
                              "grids": [{"e": 0.8}, {"e": 0.9}]})");
  CHECK(grid.grids[0].tau_max == std::vector{1.0});
  CHECK(grid.grids[1].tau_max == std::vector{2.0});
}

TEST_CASE("negative zero is zero") {
  CHECK_FALSE(std::signbit(parse(with("e", "-0.0")).grids[0].e[0]));
}

TEST_CASE("a grid of disks has d = 2, and limits of its own") {
  CHECK(parse(with("e", "0.8")).grids[0].d == std::vector{3});
  CHECK(parse(with("d", "2")).grids[0].d == std::vector{2});
  CHECK(parse(with("d", "[2, 3]")).grids[0].d == std::vector{2, 3});
  check_complaint(with("d", "1"),
                  "g.json: /d: 1 is not accepted; expected a dimension, 3 (spheres) or 2 (disks), "
                  "or a list of both");
  check_complaint(with("d", "[3, 2.5]"),
                  "g.json: /d/1: 2.5 is not accepted; expected a dimension, 3 (spheres) or 2 "
                  "(disks)");
  check_complaint(R"({"d": 2, "e": 0.8, "n": [0.4, 1.2], "N": 1000, "seeds": 1, "tau_max": 90})",
                  "g.json: /n/1: 1.2 is too dense: disks would fill 0.942 of their box; expected "
                  "less than close packing, pi/sqrt(12) = 0.907, n below 1.15");
  CHECK(complaint(R"({"d": 3, "e": 0.8, "n": 1.2, "N": 1000, "seeds": 1, "tau_max": 90})") ==
        "no complaint");
  check_complaint(
      R"({"d": [2, 3], "e": 0.8, "n": 1, "N": 3, "seeds": 1, "tau_max": 90})",
      "g.json: /N: 3 disks at n = 1 have a box of 3 sigma^2; expected a side of at least "
      "2 sigma, N >= 4");
}

// ---- the notation of numbers ------------------------------------------------------------------

TEST_CASE("a number is read as the shortest decimal within 1e-12 of it") {
  CHECK(parse(with("e", "0.8500000000000001")).grids[0].e == std::vector{0.85});
  CHECK(parse(with("e", "[0.1, 0.30000000000000004]")).grids[0].e == std::vector{0.1, 0.3});
  CHECK(parse(with("e", "0.850000001")).grids[0].e == std::vector{0.850000001});
  CHECK(parse(with("tau_max", R"({"0.8000000000000002": 90})")).grids[0].tau_max ==
        std::vector{90.0});
  CHECK(parse(with("effects", R"({"shuffle": {"every": 0.30000000000000004}})"))
            .grids[0]
            .effects.front() == R"({"shuffle":{"every":0.3}})");
  check_complaint(with("e", "[0.85, 0.8500000000000001]"),
                  "g.json: /e/1: 0.85 is already at /e/0; expected each value once");
}

TEST_CASE("more jobs than a plan can hold are refused before they are made") {
  CHECK(
      complaint(R"({"e": [0.7, 0.8, 0.9], "n": 0.4, "N": 100, "seeds": 1000000, "tau_max": 5})") ==
      "g.json: makes 3e+06 jobs in all; expected at most 2e+06 in one plan");
  std::string many = "[0.001";
  for (int k = 2; k <= 1000; ++k) many += "," + std::to_string(k) + "e-3";
  many += "]";
  CHECK(complaint(with("effects", R"({"thermostat": {"rate": )" + many +
                                      R"(}, "roughness": {"q": 0.4, "beta": )" + many + "}}"))
            .find("/effects: makes 1e+06 combinations of effects; expected at most 10000") !=
        std::string::npos);
}

TEST_CASE("the time to read a list of 10^5 seeds does not grow with its square") {
  std::string seeds = "[0";
  for (int k = 1; k < 100'000; ++k) seeds += "," + std::to_string(k);
  const auto begin = std::chrono::steady_clock::now();
  CHECK(parse(with("seeds", seeds + "]")).grids[0].seeds.size() == 100'000);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  CHECK(took.count() < 10);  // 0.5 s on one core at 3 GHz; quadratic time took minutes
}
