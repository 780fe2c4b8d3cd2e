// SPDX-License-Identifier: GPL-3.0-or-later

// Times that lie beyond a run, or between its samples.
#include "schema/grid/examination/tau.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "schema/grid/complaint.hpp"

using namespace haff::schema;

TEST_CASE("a tau_max map must name each e of its grid once, and no other") {
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

TEST_CASE("samples must be at least a collision apart and within the run") {
  check_complaint(with("sample_every", "0.001"),
                  "g.json: /sample_every: 0.001 is less than one collision of 1000 particles; "
                  "expected at least 2/N = 0.002");
  CHECK(complaint(with("sample_every", "0.002")) == "no complaint");
  check_complaint(
      with("sample_every", "[1, 100]"),
      "g.json: /sample_every/1: 100 is longer than the run; expected at most tau_max = 90");
}

TEST_CASE("the times of profiles and fields are set where these are asked for") {
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

TEST_CASE("profiles and fields are taken at samples within the run") {
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

TEST_CASE("waiting times of msd and vacf are samples of the run, in one spelling, and few") {
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

TEST_CASE("samples and snapshots may have moments of their own, in every form") {
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
  // Beside "grids" it is the default of all grids.
  CHECK(parse(R"({"e": 0.8, "n": 0.4, "N": 1000, "seeds": 1, "tau_max": 9, "sample_at": [0.5],
                  "grids": [{}, {"sample_at": [2.5]}]})")
            .grids[1]
            .sample_at.tau.listed == std::vector{2.5});
}

TEST_CASE("moments beyond the run, or that are not moments, are refused") {
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
