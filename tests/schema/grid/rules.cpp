// SPDX-License-Identifier: GPL-3.0-or-later

// The JSON of a grid is checked against its schema: one message says what was expected.
#include "schema/grid/rules.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "schema/grid/complaint.hpp"

using namespace haff::schema;

TEST_CASE("an unknown key is named with the nearest known one") {
  check_complaint(with("tau_mx", "1"), "g.json: /tau_mx: unknown key; did you mean \"tau_max\"?");
  check_complaint(with("E", "1"), "g.json: /E: unknown key; did you mean \"e\"?");
  check_complaint(with("sample_evry", "1"),
                  "g.json: /sample_evry: unknown key; did you mean \"sample_every\"?");
  check_complaint(R"({"grids": [{"e": 0.8}, {"seed": 1}]})",
                  "g.json: /grids/1/seed: unknown key; did you mean \"seeds\"?");
  check_complaint(
      with("density", "1"),
      "g.json: /density: unknown key; expected one of \"N\", \"checkpoint_every\", "
      "\"d\", \"e\", \"effects\", \"equilibrate\", \"fields_at\", \"grids\", \"n\", \"name\", "
      "\"observables\", "
      "\"profiles_every\", \"sample_at\", \"sample_every\", \"seeds\", \"snapshots_at\", "
      "\"start\", \"target\", \"tau_max\"");
  check_complaint(R"({"E": 0.8, "n": 0.4, "N": 100, "seeds": 1, "tau_max": 1})",
                  "g.json: /E: unknown key; did you mean \"e\"?");
  check_complaint(
      with("a/b~c", "1"),
      "g.json: /a~1b~0c: unknown key; expected one of \"N\", \"checkpoint_every\", "
      "\"d\", \"e\", \"effects\", \"equilibrate\", \"fields_at\", \"grids\", \"n\", \"name\", "
      "\"observables\", "
      "\"profiles_every\", \"sample_at\", \"sample_every\", \"seeds\", \"snapshots_at\", "
      "\"start\", \"target\", \"tau_max\"");
}

TEST_CASE("a key of earlier versions is refused with the reason") {
  check_complaint(with("precision", "\"double\""),
                  "g.json: /precision: is no longer a key: every run is in double; leave it out");
}

TEST_CASE("a value of the wrong type or out of range is shown with what was expected") {
  check_complaint("[]",
                  "g.json: [] is not accepted; expected a JSON object: one grid, or a list "
                  "\"grids\" with defaults for all beside it");
  check_complaint("3",
                  "g.json: 3 is not accepted; expected a JSON object: one grid, or a list "
                  "\"grids\" with defaults for all beside it");
  check_complaint(R"({"grids": []})",
                  "g.json: /grids: [] is not accepted; expected a list of grids, at least one");
  check_complaint(R"({"grids": {}})",
                  "g.json: /grids: {} is not accepted; expected a list of grids, at least one");
  check_complaint(R"({"grids": [3]})",
                  "g.json: /grids/0: 3 is not accepted; expected a grid: an object with e, n, N, "
                  "seeds and tau_max, here or beside \"grids\"");
  check_complaint(with("name", "3"), "g.json: /name: 3 is not accepted; expected a name, as text");
  check_complaint(with("e", "\"0.8\""),
                  "g.json: /e: \"0.8\" is not accepted; expected a normal restitution coefficient, "
                  "from 0 to 1, or a list of them");
  check_complaint(with("e", "true"),
                  "g.json: /e: true is not accepted; expected a normal restitution coefficient, "
                  "from 0 to 1, or a list of them");
  check_complaint(with("e", "null"),
                  "g.json: /e: null is not accepted; expected a normal restitution coefficient, "
                  "from 0 to 1, or a list of them");
  check_complaint(with("e", "1.2"),
                  "g.json: /e: 1.2 is not accepted; expected a normal restitution coefficient, "
                  "from 0 to 1, or a list of them");
  check_complaint(with("e", "-0.1"),
                  "g.json: /e: -0.1 is not accepted; expected a normal restitution coefficient, "
                  "from 0 to 1, or a list of them");
  check_complaint(with("e", "[]"),
                  "g.json: /e: [] is not accepted; expected a normal restitution coefficient, from "
                  "0 to 1, or a list of them");
  check_complaint(with("e", "[0.8, [0.9]]"),
                  "g.json: /e/1: [0.9] is not accepted; expected a normal restitution coefficient, "
                  "from 0 to 1");
  check_complaint(R"({"grids": [{"e": 0.8}, {"e": [0.8, 1.2]}]})",
                  "g.json: /grids/1/e/1: 1.2 is not accepted; expected a normal restitution "
                  "coefficient, from 0 to 1");
  check_complaint(with("n", "0"),
                  "g.json: /n: 0 is not accepted; expected a number density [sigma^-d], from 1e-6 "
                  "to below close packing: sqrt(2) = 1.41421 for spheres, 2/sqrt(3) = 1.1547 for "
                  "disks, more for a mixture with smaller particles, or a list of them");
  check_complaint(with("n", "1.5"),
                  "g.json: /n: 1.5 is too dense: spheres would fill 0.785 of their box; expected "
                  "less than close packing, pi/sqrt(18) = 0.740, n below 1.41");
  check_complaint(with("N", "1"),
                  "g.json: /N: 1 is not accepted; expected a number of particles, a whole number "
                  "from 2 to below 2^28, or a list of them");
  check_complaint(with("N", "1000.5"),
                  "g.json: /N: 1000.5 is not accepted; expected a number of particles, a whole "
                  "number from 2 to below 2^28, or a list of them");
  check_complaint(with("N", "{}"),
                  "g.json: /N: {} is not accepted; expected a number of particles, a whole number "
                  "from 2 to below 2^28, or a list of them");
  check_complaint(with("seeds", "0"),
                  "g.json: /seeds: 0 is not accepted; expected a list of seeds, or a count K from "
                  "1 to 1000000 that stands for 1 ... K");
  check_complaint(with("seeds", "1.5"),
                  "g.json: /seeds: 1.5 is not accepted; expected a list of seeds, or a count K "
                  "from 1 to 1000000 that stands for 1 ... K");
  check_complaint(with("seeds", "[1, -1]"),
                  "g.json: /seeds/1: -1 is not accepted; expected a seed, a whole number from 0 to "
                  "9007199254740991 (2^53 - 1)");
  check_complaint(with("seeds", "[9007199254740992]"),
                  "g.json: /seeds/0: 9007199254740992 is not accepted; expected a seed, a whole "
                  "number from 0 to 9007199254740991 (2^53 - 1)");
  check_complaint(with("seeds", "[]"),
                  "g.json: /seeds: [] is not accepted; expected a list of seeds, or a count K from "
                  "1 to 1000000 that stands for 1 ... K");
  check_complaint(with("tau_max", "0"),
                  "g.json: /tau_max: 0 is not accepted; expected a number above 0 and at most 1e9 "
                  "[collisions per particle], or an object from each e to such a number");
  check_complaint(with("tau_max", "[90]"),
                  "g.json: /tau_max: [90] is not accepted; expected a number above 0 and at most "
                  "1e9 [collisions per particle], or an object from each e to such a number");
  check_complaint(with("tau_max", "{}"),
                  "g.json: /tau_max: {} is not accepted; expected a number above 0 and at most 1e9 "
                  "[collisions per particle], or an object from each e to such a number");
  check_complaint(with("tau_max", R"({"0.8": -1})"),
                  "g.json: /tau_max/0.8: -1 is not accepted; expected collisions per particle, a "
                  "number above 0 and at most 1e9");
  check_complaint(with("sample_every", "0"),
                  "g.json: /sample_every: 0 is not accepted; expected an interval between samples "
                  "[collisions per particle], above 0 and at most 1e9, or a list of them");
  check_complaint(
      with("equilibrate", "25"),
      "g.json: /equilibrate: 25 is not accepted; expected the length of equilibration [elastic "
      "collisions per particle], a multiple of 10 from 10 to 1e6, or a list of them");
  check_complaint(
      with("equilibrate", "0"),
      "g.json: /equilibrate: 0 is not accepted; expected the length of equilibration [elastic "
      "collisions per particle], a multiple of 10 from 10 to 1e6, or a list of them");
  check_complaint(with("checkpoint_every", "[10, 20]"),
                  "g.json: /checkpoint_every: [10,20] is not accepted; expected an interval "
                  "between checkpoints [collisions per particle], above 0 and at most 1e9");
  check_complaint(with("observables", "[]"),
                  "g.json: /observables: [] is not accepted; expected the name of an observable, "
                  "or a list of them");
  check_complaint(with("observables", "\"laguere\""),
                  "g.json: /observables: \"laguere\" is not accepted; did you mean \"laguerre\"?");
  check_complaint(
      with("observables", "[\"laguere\"]"),
      "g.json: /observables/0: \"laguere\" is not accepted; did you mean \"laguerre\"?");
  check_complaint(
      with("observables", "[\"pressure\"]"),
      "g.json: /observables/0: \"pressure\" is not accepted; expected one of "
      "\"temperature\", \"laguerre\", \"distribution\", \"tail\", "
      "\"correlations\", \"structure\", \"pair_distribution\", "
      "\"energy_spectrum\", \"clusters\", \"cluster_sizes\", \"collision_statistics\", \"msd\", "
      "\"vacf\", \"fields\"");
  check_complaint(with("observables", "[3]"),
                  "g.json: /observables/0: 3 is not accepted; expected the name of an observable");
}

TEST_CASE("a long value is cut in the message") {
  check_complaint(
      with("name", "[" + std::string(200, ' ') +
                       R"("the quick brown fox jumps over the lazy dog, and once more over it"])"),
      "g.json: /name: [\"the quick brown fox jumps over the lazy dog, and once more... is not "
      "accepted; expected a name, as text");
}

TEST_CASE("numbers too large or too small for a run are refused") {
  for (const auto& each : std::vector<std::pair<std::string, std::string>>{
           {"tau_max", "1e12"},
           {"tau_max", "1e300"},
           {"tau_max", R"({"0.8": 1e12})"},
           {"equilibrate", "1e9"},
           {"n", "1e-9"},
           {"checkpoint_every", "1e300"},
           {"sample_every", "1e-300"},
           {"effects", R"({"shuffle": {"every": 1e18}})"},
           {"effects", R"({"thermostat": {"rate": 1e300}})"},
           {"effects", R"({"restitution": {"law": "threshold", "speed": 1e-300}})"},
           {"effects", R"({"restitution": {"law": "tc", "t_c": 1e200}})"},
           {"effects", R"({"roughness": {"beta": 0, "q": 1e-300}})"},
           {"seeds", "2000000"}}) {
    const std::string key = each.first, value = each.second;
    CAPTURE(key);
    CAPTURE(value);
    CHECK(complaint(with(key, value)).starts_with("g.json: /" + key));
  }
  check_complaint(
      with("tau_max", "1e12"),
      "g.json: /tau_max: 1000000000000.0 is not accepted; expected a number above 0 and "
      "at most 1e9 [collisions per particle], or an object from each e to such a number");
  check_complaint(with("tau_max", "2e8"),
                  "g.json: /sample_every: 1 makes 2e+08 samples of a run to tau_max = 2e+08; "
                  "expected at most 10^7, sample_every >= 20");
}
