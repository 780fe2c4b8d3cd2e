// SPDX-License-Identifier: GPL-3.0-or-later

// The meaning of a question, and questions that make no sense.
#include "campaign/curves/question.hpp"

#include <doctest/doctest.h>

using namespace haff::campaign;

namespace {

const Vocabulary words{.columns = {"time", "temperature", "pressure", "a2", "gamma_ratio"},
                       .profiles = {"G_parallel", "rho"},
                       .parameters = {"d", "e", "n", "N", "roughness.beta"}};

Topic topic_of(const std::string& y, const std::string& against, const std::string& where = "") {
  return topic_of({.y = y, .against = against, .where = where}, words);
}

}  // namespace

TEST_CASE("question: a column is a curve in tau, or in time") {
  CHECK(topic_of("a2", "").kind == Topic::Kind::series);
  CHECK(topic_of("a2", "").x == "tau");
  CHECK(topic_of("a2/temperature", "time").kind == Topic::Kind::series);
}

TEST_CASE("question: against a parameter it is one number per run") {
  CHECK(topic_of("tau_c", "e").kind == Topic::Kind::quantity);
  const Topic plateau = topic_of("a2", "roughness.beta");
  CHECK(plateau.kind == Topic::Kind::quantity);
  CHECK(plateau.quantity.from == 5);
  CHECK(plateau.quantity.to == 15);
  const Topic rate = topic_of("gamma_ratio@20", "1/N");
  CHECK(rate.kind == Topic::Kind::quantity);
  CHECK(rate.quantity.from == 18);
  const Topic pressure = topic_of("pressure@5:15", "n");
  CHECK(pressure.kind == Topic::Kind::mean);
  CHECK(pressure.window == std::pair(5.0, 15.0));
  CHECK(topic_of("pressure", "n", "tau = 20").kind == Topic::Kind::mean);
}

TEST_CASE("question: a profile is a curve in its own variable") {
  CHECK(topic_of("G_parallel", "").x == "r");
  CHECK(topic_of("G_parallel@50", "r").where.find("tau BETWEEN 49.99") == 0);
  CHECK(topic_of("rho", "c").kind == Topic::Kind::profile);
  CHECK(topic_of("G_parallel@50", "e").kind == Topic::Kind::quantity);
  CHECK_THROWS_AS(topic_of("rho", "tau"), QuestionError);
}

TEST_CASE("question: an unknown name is refused with the nearest known one") {
  CHECK_THROWS_WITH(topic_of("temprature", "tau"),
                    doctest::Contains("did you mean \"temperature\"?"));
  CHECK_THROWS_WITH(topic_of("a2", "timee"), doctest::Contains("did you mean \"time\"?"));
  CHECK_THROWS_WITH(topic_of({.y = "a2", .by = {"roughnes.beta"}}, words),
                    doctest::Contains("did you mean \"roughness.beta\"?"));
  CHECK_THROWS_WITH(topic_of({.y = "a2", .difference = {{"rougness", "none"}}}, words),
                    doctest::Contains("did you mean \"roughness\"?"));
}

TEST_CASE("question: a tau is required where one is needed, and refused elsewhere") {
  CHECK_THROWS_WITH(topic_of("pressure", "n"), doctest::Contains("pressure@20"));
  CHECK_THROWS_WITH(topic_of("tau_c", "tau"), doctest::Contains("one number of each run"));
  CHECK_THROWS_WITH(topic_of("a2@20", "tau"), doctest::Contains("one number of each run"));
  CHECK_THROWS_WITH(topic_of("a2@x", "e"), doctest::Contains("expected a tau or a window"));
  CHECK_THROWS_WITH(topic_of("rho@5", "e"), doctest::Contains("no number of a run"));
  CHECK_THROWS_WITH(topic_of("", "e"), doctest::Contains("what is to be drawn?"));
}
