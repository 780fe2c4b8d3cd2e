// SPDX-License-Identifier: GPL-3.0-or-later

// Gases that do not fit into their box or into memory, or that cannot be prepared.
#include "schema/grid/examination/box.hpp"

#include <doctest/doctest.h>

#include <optional>
#include <string>

#include "schema/grid/complaint.hpp"

using namespace haff::schema;

TEST_CASE("a box or a machine that is too small is refused with numbers") {
  check_complaint(
      with("N", "3"),
      "g.json: /N: 3 particles at n = 0.4 have a box of 7.5 sigma^3; expected a side of "
      "at least 2 sigma, N >= 4");
  check_complaint(with("N", "[1000, 3]"),
                  "g.json: /N/1: 3 particles at n = 0.4 have a box of 7.5 sigma^3; "
                  "expected a side of at least 2 sigma, N >= 4");
  CHECK(complaint(with("N", "4")) == "no complaint");
  check_complaint(R"({"n": 0.4, "grids": [{"e": 1, "N": 2, "seeds": 1, "tau_max": 1}]})",
                  "g.json: /grids/0/N: 2 particles at n = 0.4 have a box of 5 sigma^3; "
                  "expected a side of at least 2 sigma, N >= 4");
  check_complaint(with("N", "1e8"),
                  "g.json: /N: 100000000.0 particles need 20 GB; expected at most the 8 GB of this "
                  "machine, and N below 2^28");
  check_complaint(with("N", "1e300"),
                  "g.json: /N: 1e+300 is not accepted; expected a number of particles, a whole "
                  "number from 2 to below 2^28, or a list of them");
}

TEST_CASE("the density limit of a mixture depends on the volume of its particles") {
  const auto mixture = [](const std::string& n, const std::string& fraction,
                          const std::string& diameter) {
    return complaint(
        R"({"e": 0.9, "n": )" + n +
        R"(, "N": 1008, "seeds": 1, "tau_max": 5, "effects": {"mixture": {"fraction": )" +
        fraction + R"(, "diameter_ratio": )" + diameter + R"(, "mass_ratio": 1}}})");
  };
  CHECK(mixture("3", "0.857", "0.4") == "no complaint");   // packing 0.31
  CHECK(mixture("1.25", "0.9", "0.1") == "no complaint");  // 0.07
  CHECK(
      mixture("3", "0.5", "0.9") ==
      "g.json: /n: 3 is too dense: spheres would fill 1.36 of their box; expected less than close "
      "packing, pi/sqrt(18) = 0.740, n below 1.64");
}

TEST_CASE("a gas that cannot be prepared is refused where its N stands") {
  const auto never = [](const Preparation& gas) {
    return gas.particles == 100 ? std::optional<std::string>("particles jam; expected 108")
                                : std::nullopt;
  };
  try {
    parse_grid(with("N", "[108, 100]"), "g.json", machine, never);
    FAIL("not refused");
  } catch (const GridError& error) {
    CHECK(std::string(error.what()) == "g.json: /N/1: 100 particles jam; expected 108");
  }
}

TEST_CASE("observables that need a larger box are refused") {
  const std::string grid = R"({"e": 0.8, "n": 0.4, "N": 100, "seeds": 1, "tau_max": 90,
                               "observables": ["temperature", )";
  check_complaint(grid + "\"structure\"]}",
                  "g.json: /observables/1: \"structure\" needs a box wider than 8 sigma, which 100 "
                  "particles at n = 0.4 do not fill; expected N above 205");
  CHECK(complaint(grid + "\"correlations\"]}") == "no complaint");
  check_complaint(
      R"({"d": 2, "e": 0.8, "n": 0.4, "N": 6, "seeds": 1, "tau_max": 90,
          "observables": ["temperature", "correlations"]})",
      "g.json: /observables/1: \"correlations\" needs a box wider than 4 sigma, which 6 particles "
      "at n = 0.4 do not fill; expected N above 6.4");
}

TEST_CASE("the smallest gas is too small for averages over distances") {
  check_complaint(with("N", R"(4, "observables": ["structure"], "profiles_every": 5)"),
                  "g.json: /observables/0: \"structure\" needs a box wider than 8 sigma, which 4 "
                  "particles at n = 0.4 do not fill; expected N above 205");
  CHECK(complaint(with("N", R"(4, "observables": ["correlations"], "profiles_every": 5)"))
            .starts_with("g.json: /observables/0: \"correlations\" needs a box wider than"));
}
