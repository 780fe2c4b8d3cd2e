// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/statistics/late_stage.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "support/relative.hpp"

using haff::tests::off;
using namespace haff::analysis;
using doctest::Approx;

TEST_CASE("late stage: the exponent of a power law in a given range") {
  std::vector<double> tau, temperature;
  for (int k = 0; k <= 400; ++k) {
    tau.push_back(k);
    temperature.push_back(k < 100 ? std::exp(-0.1 * k) : 7 * std::pow(k, -3.5));
  }
  const PowerLaw fit = late_exponent(tau, temperature, 100, 400);
  CHECK(fit.exponent == Approx(-3.5).epsilon(1e-12));
  CHECK(fit.prefactor == Approx(7).epsilon(1e-10));
  CHECK(fit.standard_error < 1e-10);
}

TEST_CASE("late stage: the standard error comes from the scatter") {
  // Alternating residuals of size s: standard error s sqrt(n/(n-2)) / sqrt(sum (x - mean)^2).
  std::vector<double> tau, temperature;
  double sum = 0, squares = 0;
  for (int k = 0; k < 100; ++k) {
    const double x = std::log(100 + k);
    tau.push_back(100 + k);
    temperature.push_back(std::exp(-3 * x + (k % 2 == 0 ? 0.01 : -0.01)));
    sum += x;
    squares += x * x;
  }
  const PowerLaw fit = late_exponent(tau, temperature, 0, 1000);
  const double expected = 0.01 * std::sqrt(100.0 / 98) / std::sqrt(squares - sum * sum / 100);
  CHECK(off(fit.standard_error, expected) < 0.01);
  CHECK(std::abs(fit.exponent + 3) < fit.standard_error);
}

TEST_CASE("late stage: too few samples are refused") {
  const std::vector<double> two{1, 2};
  CHECK_THROWS_AS(late_exponent(two, two, 0, 10), std::invalid_argument);
  CHECK_THROWS_AS(late_exponent(two, std::vector<double>{1}, 0, 10), std::invalid_argument);
}
