// SPDX-License-Identifier: GPL-3.0-or-later

// The series of a store that the figures draw.
#include "campaign/results/averages.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <set>
#include <string>
#include <variant>

#include "support/synthetic_store.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

schema::Store empty_store() {
  return schema::Store::in_memory();
}

}  // namespace

TEST_CASE("averages: a mean series is that of the store's view, with NaN for missing values") {
  auto store = empty_store();
  add_finished(store, 0.8, 0.4, 1000, 2, 5);
  const Averages averages = read_averages(store);
  REQUIRE(averages.series.size() == 1);
  const MeanSeries& series = averages.series.front();
  CHECK(series.e == 0.8);
  CHECK(series.particles == 1000);
  CHECK(series.tau == std::vector<double>{0, 1, 2, 3, 4, 5});
  CHECK(series.most_realizations() == 2);
  CHECK(std::isnan(series.gamma_ratio.value.front()));  // no interval before the first sample
  CHECK(std::isfinite(series.gamma_ratio.error.back()));
}

TEST_CASE("averages: one realization has no errors") {
  auto store = empty_store();
  add_finished(store, 0.8, 0.4, 1000, 1, 3);
  CHECK(std::isnan(read_averages(store).series.front().temperature.error.back()));
}

TEST_CASE("averages: for each e the series with the most particles in all is drawn") {
  auto store = empty_store();
  add_finished(store, 0.8, 0.4, 1000, 3, 3);
  add_finished(store, 0.8, 0.4, 5000, 1, 3);
  add_finished(store, 0.8, 0.4, 4000, 2, 3, 0.5);  // another series, which is sampled more often
  add_finished(store, 0.9, 0.4, 1000, 1, 3);
  const auto chosen = choose_series(read_averages(store), 0.4, &MeanSeries::a2);
  REQUIRE(chosen.size() == 2);
  CHECK(chosen[0].e == 0.8);
  CHECK(chosen[0].particles == 4000);
  CHECK(chosen[0].sample_every == 0.5);
  CHECK(chosen[1].e == 0.9);
}

TEST_CASE("averages: other densities and elastic gases are not drawn") {
  auto store = empty_store();
  add_finished(store, 0.8, 0.3, 1000, 1, 3);
  CHECK(choose_series(read_averages(store), 0.4, &MeanSeries::temperature).empty());
}

TEST_CASE("averages: a series without the observable is passed over") {
  Averages averages;
  averages.series.push_back(
      {.e = 0.8, .n = 0.4, .particles = 9000, .realizations = {1, 1}, .tau = {0, 1}});
  averages.series.push_back(
      {.e = 0.8, .n = 0.4, .particles = 1000, .realizations = {1, 1}, .tau = {0, 1}});
  averages.series[0].a2.value = {NAN, NAN};
  averages.series[1].a2.value = {0.0, -0.01};
  const auto chosen = choose_series(averages, 0.4, &MeanSeries::a2);
  REQUIRE(chosen.size() == 1);
  CHECK(chosen.front().particles == 1000);
}

TEST_CASE("averages: the series nearest to a wanted e") {
  std::vector<MeanSeries> series(3);
  series[0].e = 0.80;
  series[1].e = 0.88;
  series[2].e = 0.95;
  CHECK(nearest(series, 0.90).e == 0.88);
}

TEST_CASE("averages: tau_c exists only where some realization reached it") {
  auto store = empty_store();
  add_finished(store, 0.8, 0.4, 1000, 2, 90);
  add_finished(store, 0.95, 0.4, 1000, 2, 20);
  const auto chosen = choose_tau_c(read_averages(store), 0.4);
  REQUIRE(chosen.size() == 1);
  CHECK(chosen.front().reached == 2);
  CHECK(chosen.front().tau_c == doctest::Approx(58.6).epsilon(0.05));  // by the theory in use
}

TEST_CASE("averages: tau_c is that of the store's view, with Student's intervals") {
  auto store = empty_store();
  add_finished(store, 0.8, 0.4, 1000, 4, 90);
  const auto chosen = choose_tau_c(read_averages(store), 0.4);
  REQUIRE(chosen.size() == 1);
  auto rows = store.query("SELECT tau_c, tau_c_se FROM mean_tau_c");
  const auto row = rows.next();
  REQUIRE(row);
  // The view sums in the same order; SQLite's avg carries more digits.
  CHECK(chosen.front().tau_c == doctest::Approx(std::get<double>((*row)[0])).epsilon(1e-14));
  // Quantiles of Student's t with three degrees of freedom, 68.27 % and 95 %.
  const double standard_error = std::get<double>((*row)[1]);
  CHECK(chosen.front().error == doctest::Approx(1.1969 * standard_error).epsilon(1e-4));
  CHECK(chosen.front().half_interval == doctest::Approx(3.1824 * standard_error).epsilon(1e-4));
}

TEST_CASE("averages: a series holds its realizations, by seed, and says how many are missing") {
  auto store = empty_store();
  add_finished(store, 0.8, 0.4, 1000, 2, 5);
  schema::Job unfinished{
      .e = 0.8, .n = 0.4, .particles = 1000, .seed = 9, .observables = {"laguerre", "temperature"}};
  store.add({{.job = schema::equilibration_of(unfinished), .tau_max = 50},
             {.job = unfinished, .tau_max = 5}});
  const Averages averages = read_averages(store);
  REQUIRE(averages.series.size() == 1);
  const MeanSeries& series = averages.series.front();
  REQUIRE(series.runs.size() == 2);
  CHECK(series.runs[0].seed == 1);
  CHECK(series.runs[1].seed == 2);
  CHECK(series.missing == 1);
  CHECK(series.code_versions == std::set<std::string>{"synthetic"});
  const double mean = (series.runs[0].temperature[3] + series.runs[1].temperature[3]) / 2;
  CHECK(series.temperature.value[3] == doctest::Approx(mean).epsilon(1e-14));
}

TEST_CASE("averages: realizations that are added later are appended") {
  auto store = empty_store();
  add_finished(store, 0.8, 0.4, 1000, 2, 5);
  const auto before = read_averages(store).series.front().runs;
  add_finished(store, 0.8, 0.4, 1000, 3, 5);
  const auto after = read_averages(store).series.front().runs;
  REQUIRE(after.size() == 3);
  for (std::size_t i = 0; i < before.size(); ++i) {
    CHECK(after[i].job_id == before[i].job_id);
    CHECK(after[i].temperature == before[i].temperature);
  }
}

TEST_CASE("averages: each of several densities has its series") {
  auto store = empty_store();
  for (const double n : {0.1, 0.4, 0.2}) add_finished(store, 0.85, n, 1000, 1, 3);
  add_finished(store, 0.9, 0.3, 1000, 1, 3);
  const auto chosen = choose_densities(read_averages(store), 0.85, &MeanSeries::a2);
  REQUIRE(chosen.size() == 3);
  CHECK(chosen[0].n == 0.1);
  CHECK(chosen[2].n == 0.4);
}

TEST_CASE(
    "averages: printed intervals have their stated coverage, for groups of three of 201 seeds") {
  auto store = empty_store();
  add_finished(store, 0.8, 0.4, 1000, 201, 90);
  const Averages averages = read_averages(store);
  const MeanSeries& all = averages.series.front();
  const auto truth = mean_tau_c(all);
  REQUIRE(truth);
  REQUIRE(truth->reached == 201);
  int bars = 0, intervals = 0;
  constexpr int groups = 67;
  for (std::size_t g = 0; g < groups; ++g) {
    MeanSeries part = all;
    part.runs.assign(all.runs.begin() + static_cast<std::ptrdiff_t>(3 * g),
                     all.runs.begin() + static_cast<std::ptrdiff_t>(3 * g + 3));
    const auto mean = mean_tau_c(part);
    const double difference = std::abs(mean->tau_c - truth->tau_c);
    bars += difference <= mean->error;
    intervals += difference <= mean->half_interval;
  }
  // 67 binomial trials: a share of 0.683 has a deviation of 0.057, one of 0.95 a deviation of
  // 0.027. Three deviations are allowed, so a sound interval fails once in some 400 seeds. A bare
  // standard error of three values covers 0.58.
  CHECK(bars / double(groups) == doctest::Approx(0.683).epsilon(3 * 0.057 / 0.683));
  CHECK(intervals / double(groups) > 0.95 - 3 * 0.027);
}

TEST_CASE("averages: errors of a_2 are never less than those of Gaussian velocities") {
  auto store = empty_store();
  add_finished(store, 0.8, 0.4, 1000, 2, 20);
  add_finished(store, 0.9, 0.4, 1000, 1, 20);
  for (const MeanSeries& series : read_averages(store).series) {
    const double known =
        std::sqrt(8.0 / 15 / (1000.0 * static_cast<double>(series.most_realizations())));
    bool any_known = false;
    for (const double error : series.a2.error) {
      CHECK(error >= known * (1 - 1e-12));
      any_known = any_known || error == doctest::Approx(known).epsilon(1e-12);
    }
    CHECK(any_known);
  }
}
