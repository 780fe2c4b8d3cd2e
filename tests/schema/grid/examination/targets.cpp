// SPDX-License-Identifier: GPL-3.0-or-later

// Targets that the runs of a grid cannot judge.
#include "schema/grid/examination/targets.hpp"

#include <doctest/doctest.h>

#include "schema/grid/complaint.hpp"

using namespace haff::schema;

TEST_CASE("a target that the runs cannot judge is refused") {
  check_complaint(with_target(R"({"a2": {"tau": [5, 15], "se": 5e-4}})", R"("seeds": 3)"),
                  "g.json: /seeds: 3 are too few pilot runs for a target; expected at least 5 "
                  "seeds");
  check_complaint(with_target(R"({"a2": {"tau": [5, 95], "se": 5e-4}})"),
                  "g.json: /target/a2/tau/1: 95 is beyond the run; expected at most tau_max = 90");
  check_complaint(with_target(R"({"a2": {"tau": [15, 5], "se": 5e-4}})"),
                  "g.json: /target/a2/tau: [15,5] holds no interval between samples; expected a "
                  "window of at least sample_every = 1");
  check_complaint(
      with_target(R"({"tau_c": {"se": 1}})", R"("seeds": 5, "observables": ["laguerre"])"),
      "g.json: /target/tau_c: is not measured; expected \"temperature\" among the observables of "
      "this grid");
}
