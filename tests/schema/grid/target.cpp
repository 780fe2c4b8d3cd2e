// SPDX-License-Identifier: GPL-3.0-or-later

// Targets of a grid are read with their windows, or refused.
#include "schema/grid/target.hpp"

#include <doctest/doctest.h>

#include <string>

#include "schema/grid/complaint.hpp"

using namespace haff::schema;

TEST_CASE("targets are read with their windows") {
  const auto targets =
      parse(with_target(R"({"a2": {"tau": [5, 15], "se": 5e-4}, "tau_c": {"se": 0.5}})"))
          .grids[0]
          .targets;
  REQUIRE(targets.size() == 2);
  CHECK(targets[0].quantity == "a2");
  CHECK(targets[0].tau_from == 5);
  CHECK(targets[0].tau_to == 15);
  CHECK(targets[0].se == 5e-4);
  CHECK(targets[1].quantity == "tau_c");
  CHECK(targets[1].tau_to == 0);
}

TEST_CASE("a target needs a standard error above 0 and a known quantity") {
  CHECK(complaint(with_target(R"({"a2": {"tau": [5, 15], "se": 0}})")).find("/target/a2/se") !=
        std::string::npos);
  CHECK(complaint(with_target(R"({"a2": {"se": 1e-3}})")).find("/target/a2") != std::string::npos);
  CHECK(complaint(with_target(R"({"a9": {"se": 1e-3}})")).find("/target") != std::string::npos);
}

TEST_CASE("a target without its standard error is refused") {
  CHECK(
      complaint(R"({"e": 0.8, "n": 0.4, "N": 1000, "seeds": 5, "tau_max": 90,
                      "target": {"tau_c": {}}})") ==
      "g.json: /target/tau_c: has no \"se\"; expected a standard error, a number from 1e-8 to 1e6");
  CHECK(complaint(R"({"e": 0.8, "n": 0.4, "N": 1000, "seeds": 5, "tau_max": 90,
                      "target": {"a2": {"tau": [5, 15]}}})") ==
        "g.json: /target/a2: has no \"se\"; expected a standard error, a number from 1e-8 to 1e6");
}
