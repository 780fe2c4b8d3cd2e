// Which of a store's series the figures draw.
#include "campaign/averages.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/synthetic_store.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

schema::Store empty_store() {
  return schema::Store::create(":memory:");
}

}  // namespace

TEST_CASE("averages: a mean series is the store's view, absent values NaN") {
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

TEST_CASE("averages: of each e the largest system is drawn, then the most realizations") {
  auto store = empty_store();
  add_finished(store, 0.8, 0.4, 1000, 3, 3);
  add_finished(store, 0.8, 0.4, 4000, 1, 3);
  add_finished(store, 0.8, 0.4, 4000, 2, 3, 0.5);  // sampled more often: another series
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

TEST_CASE("averages: tau_c is only where some realization got there") {
  auto store = empty_store();
  add_finished(store, 0.8, 0.4, 1000, 2, 90);
  add_finished(store, 0.95, 0.4, 1000, 2, 20);
  const auto chosen = choose_tau_c(read_averages(store), 0.4);
  REQUIRE(chosen.size() == 1);
  CHECK(chosen.front().reached == 2);
  CHECK(chosen.front().tau_c == doctest::Approx(58.6).epsilon(0.05));  // the theory it is made of
}
