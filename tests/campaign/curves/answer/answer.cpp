// SPDX-License-Identifier: GPL-3.0-or-later

// Plots that answer questions, from stores made of theory and noise.
#include "campaign/curves/answer/answer.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "analysis/statistics/accuracy.hpp"
#include "campaign/results/averages.hpp"
#include "schema/error.hpp"
#include "support/synthetic_store.hpp"

using namespace haff;
using namespace haff::campaign;
using doctest::Approx;

namespace {

schema::Store two_gases(int seeds = 3) {
  auto store = schema::Store::in_memory();
  add_finished(store, 0.8, 0.4, 1000, seeds, 20);
  add_finished(store, 0.9, 0.4, 1000, seeds, 20);
  return store;
}

const std::vector<Curve>& curves(const Answer& answer) {
  return answer.plot.panels.front().curves;
}

std::size_t count(const Answer& answer, Source source) {
  return static_cast<std::size_t>(std::ranges::count_if(
      curves(answer), [&](const Curve& c) { return c.source == source && !c.x.empty(); }));
}

double number(const schema::Value& value) {
  return std::get<double>(value);
}

}  // namespace

TEST_CASE("answer: means and errors are the same as in the store's views and in the figures") {
  const auto store = two_gases();
  const Answer a2 = answer(store, {.y = "temperature", .by = {"e"}});
  REQUIRE(curves(a2).size() == 2);
  const Curve& first = curves(a2).front();
  CHECK(first.e == 0.8);
  CHECK(first.name == "e = 0.8");
  auto rows = store.query(
      "SELECT tau, temperature, temperature_se FROM mean_series WHERE e = 0.8 ORDER BY tau");
  for (std::size_t i = 0; i < first.x.size(); ++i) {
    const auto row = rows.next().value();
    // SQLite and this program sum the same three numbers, in ways that differ by rounding.
    CHECK(first.x[i] == number(row[0]));
    CHECK(first.y[i] == Approx(number(row[1])).epsilon(1e-12));
    CHECK(first.error[i] ==
          Approx(analysis::student_t(2, analysis::bar_confidence) * number(row[2])).epsilon(1e-6));
    CHECK(first.realizations[i] == 3);
  }
  CHECK_FALSE(rows.next());
}

TEST_CASE("answer: the error of a2 is never less than that of Gaussian velocities") {
  const Answer one = answer(two_gases(1), {.y = "a2", .where = "e = 0.8"});
  // sqrt(8 / (15 N)) of one realization of 1000 particles.
  CHECK(curves(one).front().error.front() == Approx(std::sqrt(8.0 / 15 / 1000)));
  CHECK(std::isnan(curves(answer(two_gases(1), {.y = "temperature"})).front().error.front()));
}

TEST_CASE("answer: different gases are never averaged, whatever parameter names the curves") {
  auto store = two_gases();
  add_finished(store, 0.8, 0.2, 1000, 3, 20);
  const Answer by_n = answer(store, {.y = "temperature", .by = {"n"}});
  REQUIRE(curves(by_n).size() == 3);
  CHECK(curves(by_n)[0].name == "n = 0.2, e = 0.8");
  CHECK(curves(by_n)[1].name == "n = 0.4, e = 0.8");
  CHECK(curves(by_n)[1].colour == curves(by_n)[2].colour);
  CHECK(curves(by_n)[0].colour != curves(by_n)[1].colour);
}

TEST_CASE("answer: an expression in columns, against an expression, under a condition") {
  const Answer ratio = answer(two_gases(), {.y = "temperature / (2.0/3)",
                                            .against = "tau * (1 - e*e) / d",
                                            .where = "e = 0.9 AND tau <= 10 AND N = 1000"});
  REQUIRE(curves(ratio).size() == 1);
  CHECK(curves(ratio).front().x.back() == Approx(10 * 0.19 / 3));
  CHECK(curves(ratio).front().y.front() == Approx(1));
}

TEST_CASE("answer: a decay rate is drawn in the middle of its interval, in tau and in time") {
  const auto in_tau = answer(two_gases(), {.y = "gamma_ratio", .where = "e = 0.8"});
  CHECK(curves(in_tau).front().x.front() == 0.5);
  const auto in_time =
      answer(two_gases(), {.y = "gamma_ratio", .against = "time", .where = "e = 0.8 AND tau >= 4"});
  CHECK(curves(in_time).front().x.front() == Approx(3.5 / 5));  // this gas has time = tau / 5
}

TEST_CASE("answer: against a parameter, each gas is a point, and other parameters make curves") {
  auto store = two_gases();
  add_finished(store, 0.8, 0.2, 1000, 3, 20);
  const Answer plateau = answer(store, {.y = "a2", .against = "e", .by = {"n"}});
  REQUIRE(curves(plateau).size() == 2);
  CHECK(curves(plateau)[1].x == std::vector<double>{0.8, 0.9});
  CHECK(plateau.plot.caption.find("a2, tau 5 to 15") == 0);
  const Answer at_20 = answer(store, {.y = "temperature@20", .against = "n", .where = "e = 0.8"});
  REQUIRE(curves(at_20).size() == 1);
  const MeanSeries series = read_averages(store).series.front();
  CHECK(curves(at_20).front().y.front() == Approx(series.temperature.value[20]).epsilon(1e-12));
}

TEST_CASE("answer: a profile has a curve for each tau") {
  auto store = schema::Store::in_memory();
  add_finished_with_profiles(store, 0.8, 0.4, 3000, 2, 20, 10, {20});
  const Answer all = answer(store, {.y = "G_parallel", .by = {"tau"}});
  REQUIRE(curves(all).size() == 3);
  CHECK(curves(all)[1].name == "tau = 10");
  CHECK(curves(answer(store, {.y = "S@20", .against = "k"})).size() == 1);
  CHECK_THROWS_AS(answer(store, {.y = "S@15"}), NothingToDraw);
}

TEST_CASE("answer: theory is drawn beside measured values, in their units") {
  const auto store = two_gases();
  const Answer energy = answer(store, {.y = "energy", .log_y = true, .theory = true});
  CHECK(count(energy, Source::theory) == 6);  // Haff's law and two energy equations of two gases
  for (const Curve& curve : curves(energy))
    if (curve.source == Source::theory && !curve.y.empty()) CHECK(curve.y.front() == Approx(1));
  const Answer a2 = answer(store, {.y = "a2", .where = "e = 0.9", .theory = true});
  CHECK(count(a2, Source::theory) == 2);  // first order, and the table's direct simulation
}

TEST_CASE("answer: in time, Haff's law is 1 / (1 + t/t_0)^2") {
  const Answer energy =
      answer(two_gases(), {.y = "energy", .against = "time", .where = "e = 0.8", .theory = true});
  const auto haff = std::ranges::find_if(
      curves(energy), [](const Curve& c) { return c.name.starts_with("energy_haff"); });
  REQUIRE(haff != curves(energy).end());
  // Each point gives a t_0, which must be the same for all.
  const auto t_0 = [&](std::size_t i) { return haff->x[i] / (1 / std::sqrt(haff->y[i]) - 1); };
  CHECK(t_0(20) == Approx(t_0(150)).epsilon(1e-3));  // error from the steps of the integral
}

TEST_CASE("answer: a line of theory ends where the data end, on either clock") {
  const auto store = two_gases();
  for (const char* against : {"tau", "time"}) {
    CAPTURE(against);
    const Answer energy = answer(
        store,
        {.y = "energy", .against = against, .where = "e = 0.8 AND tau <= 5", .theory = true});
    const double last = curves(energy).front().x.back();
    CHECK(count(energy, Source::theory) >= 2);
    for (const Curve& line : curves(energy)) {
      if (line.source != Source::theory || line.x.empty()) continue;
      CHECK(line.x.size() > 75);  // of 160 steps: the other clock may need twice as many
      CHECK(line.x.back() <= last);
      CHECK(line.x.back() > 0.98 * last);
      CHECK(line.y.size() == line.x.size());
    }
  }
}

TEST_CASE("answer: differences are taken seed by seed") {
  const auto store = two_gases();
  const Answer less = answer(store, {.y = "temperature", .difference = {{"e", "0.9"}}});
  REQUIRE(curves(less).size() == 1);
  const Curve& curve = curves(less).front();
  const auto averages = read_averages(store);
  std::vector<double> differences;
  for (std::size_t k = 0; k < 3; ++k)
    differences.push_back(averages.series[0].runs[k].temperature[10] -
                          averages.series[1].runs[k].temperature[10]);
  const auto mean = analysis::estimate(differences);
  CHECK(curve.y[10] == Approx(mean.mean).epsilon(1e-12));
  CHECK(curve.error[10] == Approx(bar(mean.standard_error, 3)).epsilon(1e-9));
  CHECK(curve.realizations[10] == 3);
}

TEST_CASE("answer: a difference needs a reference, and the same states to start from") {
  auto store = two_gases();
  CHECK_THROWS_WITH(answer(store, {.y = "a2", .difference = {{"e", "0.95"}}}),
                    doctest::Contains("no finished run with e = 0.95"));
  add_finished(store, 0.8, 0.4, 2000, 3, 20);
  CHECK_THROWS_WITH(answer(store, {.y = "a2", .where = "e = 0.8", .difference = {{"N", "2000"}}}),
                    doctest::Contains("no two of its seeds start from the same states"));
}

TEST_CASE("answer: forty gases have a scale of tones in place of a legend") {
  auto store = schema::Store::in_memory();
  for (int i = 0; i < 40; ++i) add_finished(store, 0.60 + 0.005 * i, 0.4, 200, 1, 3);
  const Answer many = answer(store, {.y = "temperature"});
  const Panel& panel = many.plot.panels.front();
  REQUIRE(panel.curves.size() == 40);
  REQUIRE(panel.scale);
  CHECK(panel.scale->low == 0.6);
  CHECK(panel.legend == "none");
  CHECK(panel.curves.front().colour != panel.curves.back().colour);
  CHECK(many.plot.caption.find("Curves of one tone") == std::string::npos);
  add_finished(store, 0.60, 0.2, 200, 1, 3);
  CHECK(answer(store, {.y = "temperature"}).plot.caption.find("Curves of one tone differ in n.") !=
        std::string::npos);
}

TEST_CASE(
    "answer: no data, wrong SQL and logarithms without positive values have different messages") {
  const auto store = two_gases();
  CHECK_THROWS_WITH_AS(answer(store, {.y = "a2", .where = "e = 0.5"}),
                       doctest::Contains("no finished run has a2, where e = 0.5"), NothingToDraw);
  CHECK_THROWS_WITH_AS(answer(store, {.y = "a2", .where = "e = = 1"}),
                       doctest::Contains("syntax error"), schema::QueryError);
  CHECK_THROWS_WITH_AS(answer(store, {.y = "a2", .where = "foo = 1"}),
                       doctest::Contains("no such column: foo"), schema::QueryError);
  CHECK_THROWS_WITH_AS(answer(store, {.y = "-temperature", .log_y = true}),
                       doctest::Contains("no y is above 0"), NothingToDraw);
}
