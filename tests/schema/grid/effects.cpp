// SPDX-License-Identifier: GPL-3.0-or-later

// Effects in a grid: they are read, refused, or expanded to one canonical text each.
#include <doctest/doctest.h>

#include <string>

#include "schema/grid/grid.hpp"
#include "schema/grid/job.hpp"

using namespace haff::schema;

namespace {

Grid parse(const std::string& effects) {
  return parse_grid(
      R"({"e": 0.8, "n": 0.4, "N": 1000, "seeds": 5, "tau_max": 90, "effects": )" + effects + "}",
      "g.json", {.bytes = 8e9, .bytes_per_particle = 200});
}

std::vector<Effects> effects(const std::string& text) {
  return parse(text).grids.at(0).effects;
}

std::string complaint(const std::string& text) {
  try {
    parse(text);
  } catch (const GridError& error) {
    return error.what();
  }
  return "no complaint";
}

using Texts = std::vector<Effects>;

}  // namespace

TEST_CASE("effects: no effects and the default law have the same text") {
  CHECK(effects("{}") == Texts{"{}"});
  CHECK(effects(R"({"restitution": {"law": "constant"}})") == Texts{"{}"});
}

TEST_CASE("effects: a law has one text, however its numbers are written") {
  const Texts tc{R"({"restitution":{"law":"tc","t_c":0.0001}})"};
  CHECK(effects(R"({"restitution": {"law": "tc", "t_c": 1e-4}})") == tc);
  CHECK(effects(R"({"restitution": {"t_c": 0.00010, "law": "tc"}})") == tc);
  CHECK(effects(R"({"restitution": {"law": "threshold", "speed": 1}})") ==
        effects(R"({"restitution": {"law": "threshold", "speed": 1.0}})"));
}

TEST_CASE("effects: lists of laws expand, and lists within laws") {
  CHECK(effects(R"({"restitution": {"law": "tc", "t_c": [1e-4, 1e-3]}})") ==
        Texts{R"({"restitution":{"law":"tc","t_c":0.0001}})",
              R"({"restitution":{"law":"tc","t_c":0.001}})"});
  CHECK(effects(R"({"restitution": [{"law": "constant"}, {"law": "threshold", "speed": 0.5}]})") ==
        Texts{"{}", R"({"restitution":{"law":"threshold","speed":0.5}})"});
}

TEST_CASE("effects: lists of an effect expand, and lists of sets of effects") {
  CHECK(effects(R"([{}, {"shuffle": {"every": 1}}])") ==
        Texts{"{}", R"({"shuffle":{"every":1.0}})"});
  CHECK(effects(R"({"shuffle": [{"every": 1}, {"every": 2}]})") ==
        effects(R"({"shuffle": {"every": [1, 2]}})"));
  CHECK(effects(R"([{"shuffle": {"every": 1}, "thermostat": [{"rate": 1}, {"rate": 2}]},
                    {"roughness": [{"beta": 0, "q": 0.4}, {"beta": [0.5, 1], "q": 1}]}])") ==
        Texts{R"({"shuffle":{"every":1.0},"thermostat":{"rate":1.0}})",
              R"({"shuffle":{"every":1.0},"thermostat":{"rate":2.0}})",
              R"({"roughness":{"beta":0.0,"q":0.4}})", R"({"roughness":{"beta":0.5,"q":1.0}})",
              R"({"roughness":{"beta":1.0,"q":1.0}})"});
  CHECK(effects(R"([{}, {"restitution": {"law": "constant"}}])") == Texts{"{}"});
}

TEST_CASE("effects: errors within a list are named with their place") {
  CHECK(complaint("[]").find("g.json: /effects: [] is not accepted") == 0);
  CHECK(complaint(R"([{}, {"shufle": {"every": 1}}])") ==
        "g.json: /effects/1/shufle: unknown key; did you mean \"shuffle\"?");
  CHECK(complaint(R"([{}, {"shuffle": [{"every": 1}, {"every": 0}]}])")
            .find("g.json: /effects/1/shuffle/1/every: 0 is not accepted") == 0);
  CHECK(complaint(R"({"shuffle": [{"every": 1}, {"every": [2, 0.001]}]})") ==
        "g.json: /effects/shuffle/1/every/1: 0.001 is less than one collision of 1000 particles; "
        "expected at least 2/N = 0.002");
  const std::string mixture = R"({"fraction": 1e-4, "diameter_ratio": 1, "mass_ratio": 1})";
  CHECK(complaint(R"([{}, {"mixture": [)" + mixture + "]}]")
            .find("g.json: /effects/1/mixture/0/fraction: 0.0001 of 1000 particles") == 0);
  CHECK(complaint(R"([{}, {"roughness": [{"beta": 2, "q": 0.4}]}])")
            .find("g.json: /effects/1/roughness/0/beta: 2 is not accepted") == 0);
  CHECK(complaint(R"([{}, {"shuffle": {"every": 1}, "mixture": )" + mixture + "}]")
            .find("g.json: /effects/1: mixture and shuffle") == 0);
  CHECK(complaint(R"([{}, {"restitution": {"law": "viscoelastic", "A": 0.1}}])")
            .find("g.json: /e: 0.8 does not go together") == 0);
}

TEST_CASE("effects: errors are named") {
  CHECK(complaint(R"({"restituton": {"law": "tc", "t_c": 1e-4}})") ==
        "g.json: /effects/restituton: unknown key; did you mean \"restitution\"?");
  CHECK(complaint(R"({"restitution": {"law": "treshold", "speed": 1}})") ==
        "g.json: /effects/restitution/law: \"treshold\" is not accepted; did you mean "
        "\"threshold\"?");
  CHECK(complaint(R"({"restitution": {"law": "tc"}})") ==
        "g.json: /effects/restitution: has no \"t_c\"; expected a duration of contact [sigma "
        "sqrt(m/E(0))], from 1e-100 to 1e6, or a list of them");
  CHECK(complaint(R"({"restitution": {"law": "tc", "t_c": 1, "speed": 1}})") ==
        "g.json: /effects/restitution/speed: unknown key; expected one of \"law\", \"t_c\"");
  CHECK(complaint(R"({"restitution": {"t_c": 1}})") ==
        "g.json: /effects/restitution: has no \"law\"; expected the name of a law of restitution");
  CHECK(complaint(R"({"restitution": {"law": "tc", "t_c": 0}})") ==
        "g.json: /effects/restitution/t_c: 0 is not accepted; expected a duration of contact "
        "[sigma sqrt(m/E(0))], from 1e-100 to 1e6, or a list of them");
  CHECK(complaint(R"({"restitution": [{"law": "tc", "t_c": [1, -1]}]})") ==
        "g.json: /effects/restitution/0/t_c/1: -1 is not accepted; expected a number from 1e-100 "
        "to 1e6");
}

TEST_CASE("effects: a list of shuffles") {
  CHECK(effects(R"({"shuffle": {"every": [1, 5]}})") ==
        Texts{R"({"shuffle":{"every":1.0}})", R"({"shuffle":{"every":5.0}})"});
  CHECK(complaint(R"({"shuffle": {}})") ==
        "g.json: /effects/shuffle: has no \"every\"; expected an interval between shuffles "
        "[collisions per particle], above 0 and at most 1e9, or a list of them");
}

TEST_CASE("effects: viscoelastic spheres have no e") {
  const auto asked = [](const std::string& keys) {
    return parse_grid(R"({"n": 0.4, "N": 1000, "seeds": 1, "tau_max": 90)" + keys + "}", "g.json",
                      {.bytes = 8e9, .bytes_per_particle = 200});
  };
  const std::string law = R"({"restitution": {"law": "viscoelastic", "A": [0.1, 0.2]}})";
  const SubGrid grid = asked(R"(, "effects": )" + law).grids.at(0);
  CHECK(grid.e.empty());
  CHECK(grid.tau_max == std::vector{90.0});
  CHECK(grid.effects == Texts{R"({"restitution":{"A":0.1,"law":"viscoelastic"}})",
                              R"({"restitution":{"A":0.2,"law":"viscoelastic"}})"});
  CHECK(complaint(law) ==
        "g.json: /e: 0.8 does not go together with the viscoelastic law, which gives every "
        "collision an e of its own; expected one of the two");
  CHECK_THROWS_WITH_AS(asked(R"(, "effects": {"shuffle": {"every": 1}})"),
                       "g.json: has no \"e\"; expected a normal restitution coefficient, from 0 to "
                       "1, or a list of them",
                       GridError);
  CHECK(complaint(R"({"restitution": {"law": "viscoelastic", "A": 0.7}})") ==
        "g.json: /effects/restitution/A: 0.7 is not accepted; expected a strength of viscous "
        "dissipation [(sqrt(E(0)/m))^(-1/5)], from 1e-100 to below 0.67, or a list of them");
}

TEST_CASE("effects: combinations that make no sense are refused by name") {
  CHECK_THROWS_WITH_AS(
      parse_grid(R"({"e": [0.9, 1], "n": 0.4, "N": 1000, "seeds": 1, "tau_max": 90,
                     "effects": {"thermostat": {"rate": 1}}})",
                 "g.json", {.bytes = 8e9, .bytes_per_particle = 200}),
      "g.json: /e/1: 1 and a thermostat do not go together: an elastic gas would grow hotter "
      "without end; expected e < 1, or roughness with beta between -1 and 1",
      GridError);
  CHECK(complaint(R"({"shuffle": {"every": 0.001}})") ==
        "g.json: /effects/shuffle/every: 0.001 is less than one collision of 1000 particles; "
        "expected at least 2/N = 0.002");
}

TEST_CASE("effects: a thermostat may heat elastic spheres where roughness loses energy") {
  const auto asked = [](const std::string& beta) {
    return parse_grid(R"({"e": 1, "n": 0.4, "N": 1000, "seeds": 1, "tau_max": 90, "effects":
        {"thermostat": {"rate": 1}, "roughness": {"q": 0.4, "beta": )" +
                          beta + "}}}",
                      "g.json", {.bytes = 8e9, .bytes_per_particle = 200});
  };
  CHECK(asked("[-0.9, 0, 0.9]").grids.at(0).effects.size() == 3);
  for (const char* beta : {"-1", "1", "[0, 1]"})
    CHECK_THROWS_WITH_AS(
        asked(beta),
        "g.json: /e: 1 and a thermostat do not go together: an elastic gas would grow hotter "
        "without end; expected e < 1, or roughness with beta between -1 and 1",
        GridError);
}

TEST_CASE("effects: targets relative to Haff's law are refused where effects change the law") {
  const auto with = [](const std::string& asked, const std::string& target) {
    return complaint(asked + R"(, "target": )" + target);
  };
  const std::string tau_c = R"({"tau_c": {"se": 1}})";
  const std::string ratio = R"({"gamma_ratio": {"tau": [5, 15], "se": 0.01}})";
  const std::string a2 = R"({"a2": {"tau": [5, 15], "se": 0.01}})";
  const std::string heated = R"([{}, {"thermostat": {"rate": 1}}])";
  CHECK(with(heated, tau_c) ==
        "g.json: /target/tau_c: does not exist with thermostat, which changes Haff's law; expected "
        "a grid without it, or another target");
  CHECK(with(R"({"roughness": {"beta": 0.5, "q": 0.4}})", ratio)
            .find("g.json: /target/gamma_ratio: does not exist with roughness") == 0);
  CHECK(with(R"({"mixture": {"fraction": 0.5, "diameter_ratio": 1, "mass_ratio": 0.1}})", tau_c)
            .find("g.json: /target/tau_c: does not exist with mixture") == 0);
  CHECK(with(heated, a2) == "no complaint");
  CHECK(with(R"({"shuffle": {"every": 1}})", tau_c) == "no complaint");
}

TEST_CASE("effects: Haff's law holds for gases with an e and without a thermostat") {
  CHECK(cools_by_haff({.e = 0.8}));
  CHECK(cools_by_haff({.e = 0.8, .effects = R"({"shuffle":{"every":1.0}})"}));
  CHECK_FALSE(cools_by_haff({.e = 0.8, .effects = R"({"thermostat":{"rate":1.0}})"}));
  CHECK_FALSE(cools_by_haff({.e = std::nullopt}));
}

TEST_CASE("effects: they are part of a job's identity, but not of its equilibration's") {
  Job plain{.e = 0.8, .n = 0.4, .particles = 1000, .seed = 1};
  Job softened = plain;
  softened.effects = R"({"restitution":{"law":"tc","t_c":0.0001}})";
  CHECK(identity(plain) != identity(softened));
  CHECK(identity(equilibration_of(plain)) == identity(equilibration_of(softened)));
}

TEST_CASE("effects: lists of roughness and mixtures") {
  CHECK(effects(R"({"roughness": {"beta": [-0.5, 0.5], "q": 0.4}})") ==
        Texts{R"({"roughness":{"beta":-0.5,"q":0.4}})", R"({"roughness":{"beta":0.5,"q":0.4}})"});
  CHECK(
      effects(R"({"mixture": {"fraction": 0.5, "diameter_ratio": 1, "mass_ratio": [0.1, 10]}})") ==
      Texts{R"({"mixture":{"diameter_ratio":1.0,"fraction":0.5,"mass_ratio":0.1}})",
            R"({"mixture":{"diameter_ratio":1.0,"fraction":0.5,"mass_ratio":10.0}})"});
}

TEST_CASE("effects: errors in roughness or a mixture are named") {
  CHECK(complaint(R"({"roughness": {"beta": 1.5, "q": 0.4}})") ==
        "g.json: /effects/roughness/beta: 1.5 is not accepted; expected a tangential restitution "
        "coefficient, from -1 (smooth) to 1 (perfectly rough), or a list of them");
  CHECK(complaint(R"({"roughness": {"beta": 0.5}})") ==
        "g.json: /effects/roughness: has no \"q\"; expected a reduced moment of inertia 4 I / (m "
        "sigma^2), from 1e-6 to 1, 0.4 for solid spheres, or a list of them");
  CHECK(complaint(R"({"mixture": {"fraction": 0.5, "diameter_ratio": 2, "mass_ratio": 1}})") ==
        "g.json: /effects/mixture/diameter_ratio: 2 is not accepted; expected the diameter of "
        "species 2 in that of species 1, from 0.05 to 1 (species 1 is the larger), or a list of "
        "them");
}

TEST_CASE("effects: effects and observables without meaning for a mixture are refused by name") {
  const std::string mixture =
      R"("mixture": {"fraction": 0.5, "diameter_ratio": 1, "mass_ratio": 0.1})";
  CHECK(complaint("{" + mixture + R"(, "shuffle": {"every": 1}})") ==
        "g.json: /effects: mixture and shuffle do not go together: species of different mass "
        "cannot exchange velocities");
  CHECK(complaint("{" + mixture + R"(}, "observables": ["temperature", "clusters"])") ==
        "no complaint");
  CHECK(complaint(R"({"mixture": {"fraction": 1e-4, "diameter_ratio": 1, "mass_ratio": 1}})") ==
        "g.json: /effects/mixture/fraction: 0.0001 of 1000 particles leaves a species without any; "
        "expected at least one of each");
}

TEST_CASE("effects: all combinations that physics allows are accepted") {
  const std::string mixture =
      R"("mixture": {"fraction": 0.5, "diameter_ratio": 0.5, "mass_ratio": 0.1})";
  const std::string roughness = R"("roughness": {"beta": 0.5, "q": 0.5})";
  const std::string laws[] = {
      R"("e": 0.8, "effects": {)",
      R"("e": 0.8, "effects": {"restitution": {"law": "tc", "t_c": 1e-3}, )",
      R"("e": 0.8, "effects": {"restitution": {"law": "threshold", "speed": 1e-3}, )",
      R"("effects": {"restitution": {"law": "viscoelastic", "A": 0.1}, )",
      R"("effects": {"restitution": {"law": "plastic", "speed": 0.1}, )"};
  for (const std::string& law : laws)
    for (const std::string& others :
         {mixture, roughness, mixture + ", " + roughness,
          mixture + ", " + roughness + R"(, "thermostat": {"rate": 1})",
          roughness + R"(, "shuffle": {"every": 1}, "thermostat": {"rate": 1})"}) {
      CAPTURE(law + others);
      CHECK_NOTHROW(parse_grid(
          R"({"n": 0.4, "N": 1000, "seeds": 1, "tau_max": 90, "d": [2, 3], )" + law + others + "}}",
          "g.json", {.bytes = 8e9, .bytes_per_particle = 200}));
    }
}

TEST_CASE("effects: a mixture equilibrates as a mixture, rough spheres as smooth ones") {
  Job job{.e = 0.8, .n = 0.4, .particles = 1000, .seed = 1};
  job.effects = R"({"mixture":{"diameter_ratio":1.0,"fraction":0.5,"mass_ratio":0.1}})";
  CHECK(equilibration_of(job).effects == job.effects);
  job.effects = R"({"roughness":{"beta":0.5,"q":0.4}})";
  CHECK(equilibration_of(job).effects == "{}");
}

TEST_CASE("effects: one text is parsed once, into numbers by name") {
  const Effects effects(R"({ "roughness": {"q": 0.4, "beta": 0.5},
                             "restitution": {"t_c": 1e-3, "law": "tc"} })");
  CHECK(effects.text() ==
        R"({"restitution":{"law":"tc","t_c":0.001},"roughness":{"beta":0.5,"q":0.4}})");
  CHECK(effects.law() == "tc");
  CHECK(effects.parameter("restitution", "t_c") == 1e-3);
  CHECK(effects.parameter("roughness", "q") == 0.4);
  CHECK_FALSE(effects.parameter("roughness", "mass"));
  CHECK_FALSE(effects.parameter("mixture", "q"));
  CHECK(effects.contains("roughness"));
  CHECK_FALSE(effects.none());
  CHECK(Effects(effects.text()) == effects);
  CHECK(Effects().text() == "{}");
  CHECK(Effects() == Effects("{}"));
  CHECK(Effects().law() == "constant");
  CHECK(Effects().none());
}

TEST_CASE("effects: anything but an object of objects of numbers is refused by name") {
  const auto complaint_about = [](const char* json) -> std::string {
    try {
      return Effects(json).text();
    } catch (const std::invalid_argument& wrong) {
      return wrong.what();
    }
  };
  CHECK(complaint_about("shuffle") == "not a JSON object of effects: shuffle");
  CHECK(complaint_about("[]") == "not a JSON object of effects: []");
  CHECK(complaint_about(R"({"shuffle":1})") ==
        "the effect shuffle is no JSON object of parameters: 1");
  CHECK(complaint_about(R"({"shuffle":{"every":"1"}})") ==
        R"(the parameter every of the effect shuffle is no number: "1")");
  CHECK(complaint_about(R"({"restitution":{"law":2}})") == "the law of restitution is no name: 2");
}
