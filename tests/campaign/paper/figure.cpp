// SPDX-License-Identifier: GPL-3.0-or-later

// Single figures and captions, on stores made from theory.
#include "campaign/paper/figure.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "analysis/observables/distribution.hpp"
#include "support/synthetic_store.hpp"

using namespace haff;
using namespace haff::campaign;

TEST_CASE("figures: a damaged field ends figure 8 alone") {
  Averages averages = read_averages(first_campaign());
  REQUIRE(averages.velocity_field);
  auto& field = averages.velocity_field->field;
  CHECK(figure_08(averages));
  for (const int cells : {68, 4, 17, 15, 0, -1, 1 << 30}) {  // 16 in truth
    field.cells = cells;
    CHECK_THROWS_WITH(figure_08(averages), doctest::Contains("damaged"));
  }
  field.cells = 16;
  field.components = 1;
  CHECK_THROWS_WITH(figure_08(averages), doctest::Contains("damaged"));
}

TEST_CASE("figure 3: the ratio of a Gaussian gas is one, also where a bin is wide") {
  MeanSeries gas{.e = 0.8, .n = 0.4, .particles = 1'000'000'000, .realizations = {1}, .tau = {0}};
  MeanProfile rho{.name = "rho", .realizations = 1};
  for (int bin = 0; bin < analysis::speed_bins; ++bin) {
    // The mean of exp(-c^2) over a shell, from many thin shells.
    constexpr int parts = 1000;
    double sum = 0, volume = 0;
    for (int part = 0; part < parts; ++part) {
      const double c = analysis::speed_bin * (bin + (part + 0.5) / parts);
      sum += c * c * std::exp(-c * c);
      volume += c * c;
    }
    rho.x.push_back(analysis::speed_bin * (bin + 0.5));
    rho.mean.value.push_back(sum / volume);
    rho.mean.error.push_back(std::nan(""));
  }
  gas.profiles.push_back(rho);
  Averages averages;
  averages.series.push_back(gas);
  const auto plot = figure_03(averages);
  REQUIRE(plot);
  const Curve& ratio = plot->panels[1].curves.front();
  CHECK(ratio.x.back() > 3);
  for (const double each : ratio.y) CHECK(std::abs(each - 1) < 1e-6);
}

TEST_CASE("figure 11: a decay rate belongs to the middle of its interval") {
  auto store = schema::Store::in_memory();
  add_finished(store, 0.8, 0.4, 2000, 1, 20, 2);
  const auto plot = figure_11(read_averages(store));
  REQUIRE(plot);
  const Curve& measured = plot->panels.front().curves.front();
  REQUIRE(measured.source == Source::measured);
  CHECK(measured.x[0] == 1);  // from the sample at tau = 2
  CHECK(measured.x[1] == 4);  // from those at 4 and 6, for the interval from 2 to 6
}

TEST_CASE("figure 13: E - E_Haff meets E_Haff at tau_c") {
  const auto plot = figure_13(read_averages(first_campaign()));
  REQUIRE(plot);
  const auto& curves = plot->panels.front().curves;
  const Curve& haff = curves[0];    // at e = 0.80
  const Curve& theory = curves[4];  // after two of Haff and two measured
  REQUIRE(theory.source == Source::theory);
  double crossing = 0;
  for (std::size_t i = 1; i < theory.x.size(); ++i) {
    if (theory.y[i] > haff.y[i] && crossing == 0) crossing = theory.x[i];
  }
  // 58.6 from an independent solution, to the spacing of the curve's points.
  CHECK(std::abs(crossing - 58.6) < 0.4);
}

TEST_CASE("captions: gases of the same size and number of realizations are named together") {
  std::vector<MeanSeries> series(3);
  for (auto& each : series) each.n = 0.4;
  series[0] = {.e = 0.80, .n = 0.4, .particles = 32000, .realizations = {2, 2}};
  series[1] = {.e = 0.85, .n = 0.4, .particles = 600000, .realizations = {1}};
  series[2] = {.e = 0.865, .n = 0.4, .particles = 32000, .realizations = {2}};
  CHECK(provenance(series) ==
        "n = 0.40; e = 0.80, 0.865: N = 32 000, mean of 2 realizations; e = 0.85: N = 600 000, one "
        "realization.");
}

TEST_CASE("captions: gases of several densities share e, and missing data are named") {
  std::vector<MeanSeries> series(2);
  series[0] = {
      .e = 0.85, .n = 0.05, .particles = 1000, .realizations = {3, 3, 2}, .tau = {0, 1, 2}};
  series[1] = {.e = 0.85, .n = 0.4, .particles = 1000, .realizations = {3}, .tau = {0}};
  series[1].missing = 1;
  series[1].code_versions = {"0.1.0 (1a2b)"};
  CHECK(provenance(series) ==
        "e = 0.85; n = 0.05: N = 1 000, mean of 3 realizations (2 beyond τ = 1); n = 0.40: N = "
        "1 000, mean of 3 realizations (1 planned not done). haff 0.1.0 (1a2b).");
}

TEST_CASE("figures 4 and 5: curves end where fewer than half of the realizations go on") {
  const MeanSeries gas{.e = 0.9,
                       .n = 0.4,
                       .particles = 1000,
                       .realizations = {8, 8, 4, 2},
                       .tau = {0, 100, 150, 160}};
  CHECK(homogeneous_stage(gas) == 150);
  const MeanSeries whole{
      .e = 0.9, .n = 0.4, .particles = 1000, .realizations = {1, 1}, .tau = {0, 160}};
  CHECK(homogeneous_stage(whole) == 160);
}

TEST_CASE("figure 7: smoothed over the paper's windows, against tau/tau_c") {
  const auto plot = figure_07(read_averages(first_campaign()));
  REQUIRE(plot);
  const Curve& curve = plot->panels.front().curves.front();
  CHECK(curve.e == 0.8);
  const auto averages = read_averages(first_campaign());
  const auto chosen = choose_series(averages, 0.4, &MeanSeries::a2);
  const Realization& run = chosen.front().runs.front();
  CHECK(curve.x[10] == doctest::Approx(10 / *run.tau_c));
  CHECK(curve.y[10] == doctest::Approx((run.a2[9] + run.a2[10] + run.a2[11]) / 3));
}

TEST_CASE("figure 14: every shuffled series is a curve of its own") {
  auto store = schema::Store::in_memory();
  for (const char* effects : {"{}", R"({"shuffle":{"every":1.0}})", R"({"shuffle":{"every":5.0}})"})
    add_finished(store,
                 {.e = 0.85,
                  .n = 0.4,
                  .particles = 2000,
                  .effects = effects,
                  .observables = {"laguerre", "temperature"}},
                 3, 40);
  const auto averages = read_averages(store);
  REQUIRE(averages.shuffled.size() == 2);
  const auto plot = figure_14(averages);
  REQUIRE(plot);
  const auto& curves = plot->panels.front().curves;
  REQUIRE(curves.size() == 5);  // including the theory and its first order
  CHECK(curves[0].name == "not shuffled");
  CHECK(curves[1].name == "shuffled every 1");
  CHECK(curves[2].name == "shuffled every 5");
  for (std::size_t k = 0; k < 3; ++k) {
    const MeanSeries& series = k == 0 ? averages.series.front() : averages.shuffled[k - 1];
    CHECK(curves[k].x.front() == 0);
    // A mean of the same three numbers, summed in the same order.
    CHECK(curves[k].y.front() == doctest::Approx(series.a2.value.front()).epsilon(1e-12));
    CHECK(curves[k].error.front() > 0);
    CHECK(std::ranges::is_sorted(curves[k].x));
  }
}
