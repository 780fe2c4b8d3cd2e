// SPDX-License-Identifier: GPL-3.0-or-later

// Keys that a grid leaves out, and values that it repeats.
#include "schema/grid/examination/examiner.hpp"

#include <doctest/doctest.h>

#include "schema/grid/complaint.hpp"

using namespace haff::schema;

TEST_CASE("a missing key is named") {
  check_complaint("{}",
                  "g.json: has no \"e\"; expected a normal restitution coefficient, from 0 to 1, "
                  "or a list of them");
  check_complaint(R"({"e": 0.8, "n": 0.4, "N": 100, "seeds": 1})",
                  "g.json: has no \"tau_max\"; expected a number above 0 and at most 1e9 "
                  "[collisions per particle], or an object from each e to such a number");
  check_complaint(
      R"({"n": 0.4, "N": 100, "seeds": 1, "grids": [{"e": 0.8, "tau_max": 1}, {"e": 1}]})",
      "g.json: /grids/1: has no \"tau_max\", and there is none beside \"grids\"; expected a number "
      "above 0 and at most 1e9 [collisions per particle], or an object from each e to such a "
      "number");
}

TEST_CASE("a value repeated within a list is found, however it is written") {
  check_complaint(with("e", "[0.8, 0.9, 0.80]"),
                  "g.json: /e/2: 0.8 is already at /e/0; expected each value once");
  check_complaint(with("N", "[1000, 1e3]"),
                  "g.json: /N/1: 1000.0 is already at /N/0; expected each value once");
  check_complaint(with("seeds", "[1, 2, 2.0]"),
                  "g.json: /seeds/2: 2.0 is already at /seeds/1; expected each value once");
  check_complaint(R"({"grids": [{"e": 0.8}, {"observables": ["laguerre", "laguerre"]}]})",
                  "g.json: /grids/1/observables/1: \"laguerre\" is already at "
                  "/grids/1/observables/0; expected each value once");
}
