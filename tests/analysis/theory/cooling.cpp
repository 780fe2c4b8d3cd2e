// SPDX-License-Identifier: GPL-3.0-or-later

// Haff's law, decay rates and tau_c of artificial series.
#include "analysis/theory/cooling.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

#include "support/relative.hpp"

using haff::tests::off;
using namespace haff::analysis;
using doctest::Approx;

TEST_CASE("cooling: Haff's rate and temperature") {
  CHECK(off(2 * gamma0(0.8), 0.12) < 1e-14);
  CHECK(off(2 * gamma0(0.8, 2), 0.18) < 1e-14);
  CHECK(gamma0(1) == 0);
  CHECK(off(initial_temperature(), 2.0 / 3) < 1e-14);
  CHECK(off(haff_temperature(10, 0.8), 2.0 / 3 * std::exp(-1.2)) < 1e-14);
}

TEST_CASE("cooling: a gas that follows Haff has gamma / gamma_0 = 1") {
  const double before = haff_temperature(20, 0.9), after = haff_temperature(20.5, 0.9);
  CHECK(gamma_ratio(before, after, 0.5, 0.9) == Approx(1).epsilon(1e-12));
  CHECK(std::isnan(gamma_ratio(1, 1, 1, 1.0)));
}

TEST_CASE("cooling: tau_c is where T is twice Haff's, exactly if ln T is linear") {
  // T/T_Haff = exp(tau/40): doubles at 40 ln 2 = 27.7, between samples.
  std::vector<double> tau, temperature;
  for (int k = 0; k <= 50; ++k) {
    tau.push_back(k);
    temperature.push_back(haff_temperature(k, 0.8) * std::exp(k / 40.0));
  }
  const auto found = tau_c(tau, temperature, 0.8);
  REQUIRE(found.has_value());
  CHECK(*found == Approx(40 * std::numbers::ln2).epsilon(1e-13));
}

TEST_CASE("cooling: the first of several crossings counts") {
  const std::vector<double> tau = {0, 1, 2, 3};
  std::vector<double> temperature;
  for (const double excess : {1.0, 4.0, 1.0, 4.0}) {
    temperature.push_back(excess * haff_temperature(double(temperature.size()), 0.9));
  }
  CHECK(tau_c(tau, temperature, 0.9).value() == Approx(0.5));
}

TEST_CASE("cooling: a series that never crosses has no tau_c") {
  CHECK_FALSE(tau_c(std::vector{0.0, 1.0}, std::vector{2.0 / 3, 0.5}, 0.8).has_value());
  CHECK_FALSE(tau_c({}, {}, 0.8).has_value());
  CHECK_THROWS_AS(tau_c(std::vector{0.0}, {}, 0.8), std::invalid_argument);
}

TEST_CASE("cooling: tau_c survives temperatures near the end of the exponent range") {
  // 2 gamma_0 tau = 900: exp(-900) is zero in double precision, T itself is not.
  const std::vector<double> tau = {0, 5000, 5400};
  const std::vector<double> temperature = {2.0 / 3, 1e-300, 1e-300};
  CHECK(tau_c(tau, temperature, 0.7).has_value());
}

TEST_CASE("cooling: collision rate and pressure by their definitions") {
  CHECK(collision_rate(500, 100, 2) == Approx(5));
  // An ideal gas without virial, and then a virial of 3 per unit time in V = 10.
  CHECK(pressure(0.4, 0.5, 0, 100, 1) == Approx(0.2));
  CHECK(pressure(10, 0.5, 3, 100, 1) == Approx(5.1));
}

TEST_CASE("cooling: between two samples of Haff's law the mean temperature is the geometric one") {
  // T = 1/(1 + t)^2: the mean over [a, b] is 1/((1 + a)(1 + b)), however long the interval.
  const std::vector<double> time{0, 1, 5, 40};
  std::vector<double> temperature;
  for (const double t : time) temperature.push_back(std::pow(1 + t, -2));
  for (std::size_t nodes = 2; nodes <= time.size(); ++nodes) {
    const double mean =
        mean_temperature(std::span(time).first(nodes), std::span(temperature).first(nodes));
    CHECK(mean ==
          doctest::Approx(1 / ((1 + time[nodes - 2]) * (1 + time[nodes - 1]))).epsilon(1e-13));
  }
}

TEST_CASE(
    "cooling: the error of the mean temperature falls with the fourth power of the interval") {
  // T = exp(-t + t^2/20), which is not Haff's law; its mean over [1 - h, 1] is by Simpson's rule
  // with 2000 intervals, exact to 1e-13.
  const auto temperature = [](double t) { return std::exp(-t + t * t / 20); };
  const auto error = [&](double h) {
    std::vector<double> time, values;
    for (int k = 3; k >= 0; --k) {
      time.push_back(1 - k * h);
      values.push_back(temperature(time.back()));
    }
    constexpr int intervals = 2000;
    double exact = 0;
    for (int k = 0; k <= intervals; ++k) {
      const int weight = k == 0 || k == intervals ? 1 : k % 2 == 1 ? 4 : 2;
      exact += weight * temperature(1 - h + k * h / intervals) / (3.0 * intervals);
    }
    return std::abs(mean_temperature(time, values) / exact - 1);
  };
  CHECK(error(0.4) < 1e-3);
  // 2^4 = 16; the next order makes it a little more or less.
  CHECK(error(0.4) / error(0.2) > 12);
  CHECK(error(0.2) / error(0.1) > 13);
}

TEST_CASE("cooling: the mean of a constant temperature; a single sample is refused") {
  CHECK(mean_temperature(std::vector<double>{0, 1, 2}, std::vector<double>{0.7, 0.7, 0.7}) ==
        doctest::Approx(0.7).epsilon(1e-15));
  CHECK_THROWS_AS(mean_temperature(std::vector<double>{0}, std::vector<double>{1}),
                  std::invalid_argument);
}
