// SPDX-License-Identifier: GPL-3.0-or-later

// Fits of a theory to series that are made from it.
#include "campaign/results/fits.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/synthetic_store.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

MeanSeries synthetic(double e, int seeds, double tau_max, std::uint32_t particles = 500'000) {
  auto store = schema::Store::in_memory();
  add_finished(store, e, 0.4, particles, seeds, tau_max);
  return read_averages(store).series.front();
}

}  // namespace

TEST_CASE("fits: b of a series made from the energy equation is recovered") {
  const auto fit = fitted_cutoff(synthetic(0.8, 4, 90));
  REQUIRE(fit);
  CHECK(fit->count == 4);
  CHECK(fit->standard_error > 0);
  // Noise of 1/sqrt(500 000) in ln E, which changes by 0.2 per unit of ln b: within one per cent.
  CHECK(fit->mean == doctest::Approx(0.30).epsilon(0.01));
}

TEST_CASE("fits: one realization has a fit, but no error") {
  const auto fit = fitted_cutoff(synthetic(0.8, 1, 90));
  REQUIRE(fit);
  CHECK(std::isnan(fit->standard_error));
}

TEST_CASE("fits: a few samples are not fitted") {
  CHECK_FALSE(fitted_cutoff(synthetic(0.8, 1, 5)));
}

TEST_CASE("fits: a late exponent needs a series well beyond twice tau_c") {
  CHECK_FALSE(late_exponent(synthetic(0.8, 1, 130)));
  CHECK(late_exponent(synthetic(0.8, 2, 180))->count == 2);
}

TEST_CASE("fits: the late exponent is that of T beyond 2 tau_c") {
  MeanSeries series;
  Realization run{.tau_c = 20.0};
  for (int k = 1; k <= 60; ++k) {
    run.tau.push_back(k);
    run.temperature.push_back(k < 40 ? 1.0 : std::pow(k, -3.0));
  }
  series.runs = {run};
  CHECK(late_exponent(series)->mean == doctest::Approx(3));
}

TEST_CASE(
    "fits: a realization that cannot be fitted does not prevent the others from being fitted") {
  MeanSeries series = synthetic(0.8, 3, 90);
  for (double& each : series.runs[1].temperature) each = HUGE_VAL;  // not a possible gas
  const auto fit = fitted_cutoff(series);
  REQUIRE(fit);
  CHECK(fit->count == 2);
}
