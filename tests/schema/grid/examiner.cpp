// SPDX-License-Identifier: GPL-3.0-or-later

// What no run could do is refused in one message, with what was expected.
#include "schema/grid/examiner.hpp"

#include <doctest/doctest.h>

#include <string>

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

TEST_CASE("a long value is cut") {
  check_complaint(
      with("name", "[" + std::string(200, ' ') +
                       R"("the quick brown fox jumps over the lazy dog, and once more over it"])"),
      "g.json: /name: [\"the quick brown fox jumps over the lazy dog, and once more... is not "
      "accepted; expected a name, as text");
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

TEST_CASE("a tau_max map must name the e of its grid, each once") {
  check_complaint(with("tau_max", R"({"0.9": 90})"),
                  "g.json: /tau_max/0.9: there is no such e; expected the e of this grid: 0.8");
  check_complaint(with("tau_max", R"({"0.8": 90, "0.9": 180})"),
                  "g.json: /tau_max/0.9: there is no such e; expected the e of this grid: 0.8");
  check_complaint(with("tau_max", R"({"0.8": 90, "0.80": 180})"),
                  "g.json: /tau_max/0.80: is the second entry for e = 0.8; expected one");
  check_complaint(with("tau_max", R"({"0.8": 90, "all": 180})"),
                  "g.json: /tau_max/all: is not a number; expected an e of this grid");
  check_complaint(
      R"({"e": [0.8, 0.9], "n": 0.4, "N": 100, "seeds": 1, "tau_max": {"0.8": 9}})",
      "g.json: /tau_max: has no entry for e = 0.9; expected one for each e of the grid");
  check_complaint(
      R"({"n": 0.4, "N": 100, "seeds": 1, "grids": [
      {"e": 0.8, "tau_max": {"0.8": 9}}, {"e": 0.9, "tau_max": {"0.90": 9, "0.8": 9}}]})",
      "g.json: /grids/1/tau_max/0.8: there is no such e; expected the e of this grid: 0.9");
}

TEST_CASE("a box too small, or a machine too small, is refused with numbers") {
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

TEST_CASE("samples must be at least a collision apart and within the run") {
  check_complaint(with("sample_every", "0.001"),
                  "g.json: /sample_every: 0.001 is less than one collision of 1000 particles; "
                  "expected at least 2/N = 0.002");
  CHECK(complaint(with("sample_every", "0.002")) == "no complaint");
  check_complaint(
      with("sample_every", "[1, 100]"),
      "g.json: /sample_every/1: 100 is longer than the run; expected at most tau_max = 90");
}

TEST_CASE("profiles and fields have their times where they are asked for") {
  const auto only = [](const std::string& text) { return parse(text).grids.at(0); };
  const SubGrid plain = only(with("profiles_every", "20"));
  CHECK_FALSE(plain.profiles_every);
  CHECK(plain.fields_at.empty());
  CHECK(only(with("observables", "\"distribution\"")).profiles_every == 10.0);
  const SubGrid full = only(
      with("observables", R"(["fields", "clusters"], "profiles_every": 2, "fields_at": [60, 20])"));
  CHECK(full.profiles_every == 2.0);
  CHECK(full.fields_at == std::vector{20.0, 60.0});
}

TEST_CASE("profiles and fields belong to samples within the run") {
  check_complaint(
      with("observables", R"("structure", "profiles_every": 5, "sample_every": [1, 2])"),
      "g.json: /profiles_every: 5 falls between samples; expected a multiple of sample_every = 2");
  CHECK(complaint(
            with("observables", R"("structure", "profiles_every": 0.3, "sample_every": 0.1)")) ==
        "no complaint");
  check_complaint(with("observables", R"("structure", "profiles_every": 100)"),
                  "g.json: /profiles_every: 100 is beyond the run; expected at most tau_max = 90");
  check_complaint(with("observables", R"("fields", "fields_at": [60, 95])"),
                  "g.json: /fields_at/1: 95 is beyond the run; expected at most tau_max = 90");
  check_complaint(
      with("observables", "\"fields\""),
      "g.json: has no \"fields_at\", and lists fields among its observables; expected "
      "when fields are taken [collisions per particle], a multiple of sample_every or a "
      "list of them");
  check_complaint(with("observables", R"("fields", "fields_at": -1)"),
                  "g.json: /fields_at: -1 is not accepted; expected when fields are taken "
                  "[collisions per particle], a multiple of sample_every or a list of them");
}

// ---- targets ----------------------------------------------------------------------------------

TEST_CASE("what fuzzing found: an observable wider than the box, a target without its error") {
  check_complaint(with("N", R"(4, "observables": ["structure"], "profiles_every": 5)"),
                  "g.json: /observables/0: \"structure\" needs a box wider than 8 sigma, which 4 "
                  "particles at n = 0.4 do not fill; expected N above 205");
  CHECK(complaint(with("N", R"(4, "observables": ["correlations"], "profiles_every": 5)"))
            .starts_with("g.json: /observables/0: \"correlations\" needs a box wider than"));
  check_complaint(
      with_target(R"({"a2": {"tau": [5, 15]}})"),
      "g.json: /target/a2: has no \"se\"; expected a standard error, a number from 1e-8 "
      "to 1e6");
}

TEST_CASE("no number of a grid is beyond what a run can do with it") {
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

TEST_CASE("a mixture is as dense as the volume that it fills") {
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

TEST_CASE("waiting times of msd and vacf are samples of the run, spelled in one way, and few") {
  CHECK(
      complaint(with("observables", R"(["msd", "msd@20", "vacf@0.5"])")) ==
      "g.json: /observables/2: 0.5 falls between samples; expected a multiple of sample_every = 1");
  CHECK(complaint(with("observables", R"("msd@20.0")")).find("/observables: \"msd@20.0\" is not") !=
        std::string::npos);
  CHECK(complaint(with("observables", R"("laguerre@20")")).find("is not accepted") !=
        std::string::npos);
  CHECK(complaint(with("observables", R"("msd@1000")")).find("1000 is beyond the run") !=
        std::string::npos);
  std::string many = R"(["msd")";
  for (int tau = 1; tau <= 16; ++tau) many += ", \"vacf@" + std::to_string(tau) + '"';
  CHECK(complaint(with("observables", many + "]")) ==
        "g.json: /observables/16: \"vacf@16\" is one waiting time too many; expected at most 16");
}

// ---- moments ----------------------------------------------------------------------------------

TEST_CASE("samples and snapshots at moments of their own, in every form") {
  const auto sample_at = [](const std::string& value) {
    return parse(with("sample_at", value)).grids[0].sample_at;
  };
  CHECK(sample_at("0.5").tau.listed == std::vector{0.5});
  CHECK(sample_at("[20, 0, 0.5]").tau.listed == std::vector<double>{0, 0.5, 20});
  CHECK(sample_at(R"({"log": 20})").tau == Moments{.per_decade = 20, .from = 0.1});
  CHECK(sample_at(R"({"log": 5, "from": 0.01})").tau == Moments{.per_decade = 5, .from = 0.01});
  const Schedule both = sample_at(R"({"tau": [1.5], "time": {"log": 3, "from": 2}})");
  CHECK(both.tau.listed == std::vector{1.5});
  CHECK(both.time == Moments{.per_decade = 3, .from = 2});
  CHECK(sample_at(R"({"time": [1e20, 3]})").time.listed == std::vector{3.0, 1e20});
  CHECK(parse(with("snapshots_at", "[10]")).grids[0].snapshots_at.tau.listed == std::vector{10.0});
  CHECK(parse(with("seeds", "1")).grids[0].sample_at.empty());
  // Beside "grids" it is the default of all.
  CHECK(parse(R"({"e": 0.8, "n": 0.4, "N": 1000, "seeds": 1, "tau_max": 9, "sample_at": [0.5],
                  "grids": [{}, {"sample_at": [2.5]}]})")
            .grids[1]
            .sample_at.tau.listed == std::vector{2.5});
}

TEST_CASE("moments that no run meets, or that are no moments, are refused") {
  check_complaint(with("sample_at", "[0.5, 95]"),
                  "g.json: /sample_at/1: 95 is beyond the run; expected at most tau_max = 90");
  check_complaint(with("snapshots_at", R"({"tau": {"log": 2, "from": 100}})"),
                  "g.json: /snapshots_at/tau/from: 100 is beyond the run; expected at most "
                  "tau_max = 90");
  check_complaint(with("sample_at", "[0.4995, 0.5]"),
                  "g.json: /sample_at/1: 0.5 is the same collision of 1000 particles as 0.4995; "
                  "expected 2/N = 0.002 between two moments");
  check_complaint(with("sample_at", R"({"log": 2, "time": [3]})"),
                  "g.json: /sample_at/log: stands beside \"tau\" or \"time\"; expected it within "
                  "one of them, as in {\"tau\": {\"log\": 20}}");
  check_complaint(with("sample_at", R"({"from": 1})"),
                  "g.json: /sample_at: has no \"log\"; expected so many moments a decade, as in "
                  "{\"log\": 20}");
  check_complaint(with("sample_at", R"({"time": {"from": 1}})"),
                  "g.json: /sample_at/time: has no \"log\"; expected a number of moments a decade, "
                  "a whole number from 1 to 100");
  check_complaint(with("sample_at", R"({"log": 2.5})"),
                  "g.json: /sample_at/log: 2.5 is not accepted; expected a number of moments a "
                  "decade, a whole number from 1 to 100");
  check_complaint(with("sample_at", R"({"lag": 2})"),
                  "g.json: /sample_at/lag: unknown key; did you mean \"log\"?");
  check_complaint(with("snapshots_at", R"({"time": [3, -1]})"),
                  "g.json: /snapshots_at/time/1: -1 is not accepted; expected a time since the "
                  "start of cooling [sigma sqrt(m/E(0))], from 0 to 1e100");
  check_complaint(with("sample_at", "[1.5, 1.5]"),
                  "g.json: /sample_at/1: 1.5 is already at /sample_at/0; expected each value once");
}
