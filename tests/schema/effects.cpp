// Effects in a grid: read, refused, expanded to one canonical text each.
#include <doctest/doctest.h>

#include <string>

#include "schema/grid.hpp"
#include "schema/job.hpp"

using namespace haff::schema;

namespace {

Grid parse(const std::string& effects) {
  return parse_grid(
      R"({"e": 0.8, "n": 0.4, "N": 1000, "seeds": 1, "tau_max": 90, "effects": )" + effects + "}",
      "g.json", {.bytes = 8e9, .bytes_per_particle = 200});
}

std::vector<std::string> effects(const std::string& text) {
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

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("effects: none, or the default by its name, is none") {
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

TEST_CASE("effects: lists expand, of laws and within them") {
  CHECK(effects(R"({"restitution": {"law": "tc", "t_c": [1e-4, 1e-3]}})") ==
        Texts{R"({"restitution":{"law":"tc","t_c":0.0001}})",
              R"({"restitution":{"law":"tc","t_c":0.001}})"});
  CHECK(effects(R"({"restitution": [{"law": "constant"}, {"law": "threshold", "speed": 0.5}]})") ==
        Texts{"{}", R"({"restitution":{"law":"threshold","speed":0.5}})"});
}

TEST_CASE("effects: what is wrong is named") {
  CHECK(complaint(R"({"restituton": {"law": "tc", "t_c": 1e-4}})") ==
        "g.json: /effects/restituton: unknown key; did you mean \"restitution\"?");
  CHECK(complaint(R"({"restitution": {"law": "treshold", "speed": 1}})") ==
        "g.json: /effects/restitution/law: \"treshold\" is not accepted; did you mean "
        "\"threshold\"?");
  CHECK(complaint(R"({"restitution": {"law": "tc"}})") ==
        "g.json: /effects/restitution: has no \"t_c\"; expected a duration of contact [sigma "
        "sqrt(m/E(0))], above 0, or a list of them");
  CHECK(complaint(R"({"restitution": {"law": "tc", "t_c": 1, "speed": 1}})") ==
        "g.json: /effects/restitution/speed: unknown key; expected one of \"law\", \"t_c\"");
  CHECK(complaint(R"({"restitution": {"t_c": 1}})") ==
        "g.json: /effects/restitution: has no \"law\"; expected the name of a law of restitution");
  CHECK(complaint(R"({"restitution": {"law": "tc", "t_c": 0}})") ==
        "g.json: /effects/restitution/t_c: 0 is not accepted; expected a duration of contact "
        "[sigma sqrt(m/E(0))], above 0, or a list of them");
  CHECK(complaint(R"({"restitution": [{"law": "tc", "t_c": [1, -1]}]})") ==
        "g.json: /effects/restitution/0/t_c/1: -1 is not accepted; expected a number above 0");
}

TEST_CASE("effects: a shuffle, swept") {
  CHECK(effects(R"({"shuffle": {"every": [1, 5]}})") ==
        Texts{R"({"shuffle":{"every":1.0}})", R"({"shuffle":{"every":5.0}})"});
  CHECK(complaint(R"({"shuffle": {}})") ==
        "g.json: /effects/shuffle: has no \"every\"; expected an interval between shuffles "
        "[collisions per particle], above 0, or a list of them");
}

TEST_CASE("effects: part of a job's identity, not of its equilibration's") {
  Job plain{.e = 0.8, .n = 0.4, .particles = 1000, .seed = 1};
  Job softened = plain;
  softened.effects = R"({"restitution":{"law":"tc","t_c":0.0001}})";
  CHECK(identity(plain) != identity(softened));
  CHECK(identity(equilibration_of(plain)) == identity(equilibration_of(softened)));
}
