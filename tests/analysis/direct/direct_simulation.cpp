// SPDX-License-Identifier: GPL-3.0-or-later

// The direct simulation against exact results: an elastic gas stays Gaussian; the initial slopes of
// a_2 and a_3; the initial collision rate; the balance of energy given and lost.
#include "analysis/direct/direct_simulation.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "analysis/theory/cooling.hpp"
#include "analysis/theory/enskog.hpp"
#include "analysis/theory/enskog_boltzmann.hpp"

using namespace haff::analysis;

namespace {

// For a Gaussian this gives one false alarm in 15 000 values; the seeds are fixed.
constexpr double sigmas = 4;

void check_within(const Estimate& value, double expected, double slack = 0) {
  INFO(value.mean, " +- ", value.standard_error, ", expected ", expected);
  CHECK(std::abs(value.mean - expected) < sigmas * value.standard_error + slack);
}

}  // namespace

TEST_CASE("direct simulation: an elastic gas keeps its energy and stays Gaussian") {
  const std::vector<double> tau = {0, 2, 5};
  for (const int d : {2, 3}) {
    CAPTURE(d);
    const auto all = direct_realizations({.law = ConstantRestitution{1}, .d = d}, tau,
                                         {.particles = 10'000, .realizations = 16, .seed = 7});
    for (const DirectPoint& point : direct_means(all)) {
      CHECK(point.temperature.mean == doctest::Approx(2.0 / d).epsilon(1e-12));
      for (std::size_t l = 2; l <= 4; ++l) check_within(point.laguerre[l], 0);
      check_within(point.rate_ratio, 1);
      CHECK(std::isnan(point.gamma_ratio.mean));
    }
  }
}

TEST_CASE("direct simulation: time runs at Enskog's collision rate") {
  const std::vector<double> tau = {5};
  for (const int d : {2, 3}) {
    CAPTURE(d);
    const auto all = direct_realizations({.law = ConstantRestitution{1}, .d = d, .n = 0.3}, tau,
                                         {.particles = 10'000, .realizations = 16, .seed = 8});
    const double rate = transport(0.3, 2.0 / d, d).collision_rate;
    // The energy does not fluctuate: N instead of N - 1 would show in the fourth digit.
    check_within(direct_means(all)[0].time, 5 / rate, 2e-4 * 5 / rate);
  }
}

// a_l(h) - a_l(0) = h a_l' + O(h^2). With h = 0.05 the second order is |B| h / 2 < 2 % of the
// first; comparing with (1 - exp(B h))/B, B = -0.55 (a_2), -0.9 (a_3), leaves a third of that.
TEST_CASE("direct simulation: a2 and a3 leave a Gaussian with their exact slopes") {
  constexpr double h = 0.05, relaxation[] = {0.55, 0.9}, slack = 0.02;
  const std::vector<double> tau = {0, h};
  for (const int d : {2, 3}) {
    for (const double e : {0.0, 0.4, 0.85}) {
      CAPTURE(d);
      CAPTURE(e);
      std::vector<double> slope[2];
      for (std::uint64_t stream = 0; stream < 40; ++stream) {
        const auto s =
            direct_realization({.law = ConstantRestitution{e}, .d = d}, tau, 20'000, 9, stream);
        for (std::size_t k = 0; k < 2; ++k)
          slope[k].push_back((s[1].laguerre[k + 2] - s[0].laguerre[k + 2]) * relaxation[k] /
                             -std::expm1(-relaxation[k] * h));
      }
      const InitialSlopes exact = boltzmann_initial_slopes(e, d);
      check_within(estimate(slope[0]), exact.a2, slack * std::abs(exact.a2));
      check_within(estimate(slope[1]), exact.a3, slack * std::abs(exact.a3));
    }
  }
}

TEST_CASE("direct simulation: a heated gas loses the energy that it is given") {
  constexpr double e = 0.8, rate = 0.05, n = 0.05;
  std::vector<double> tau;
  for (int k = 20; k <= 40; ++k) tau.push_back(k);
  const auto all =
      direct_realizations({.law = ConstantRestitution{e}, .d = 3, .n = n, .heating = rate}, tau,
                          {.particles = 10'000, .realizations = 8, .seed = 10});
  const DirectPoint rest = direct_plateau(all, 0);
  // rate = 2 gamma omega (3/2) T
  const double t = rest.temperature.mean;
  const double loss = 2 * gamma0(e) * rest.gamma_ratio.mean * rest.rate_ratio.mean *
                      transport(n, t).collision_rate * 1.5 * t;
  CHECK(std::abs(loss / rate - 1) < 0.006);  // eight realizations of 10^4 particles
  // The theory is of first order in a_2: its a_2 is good to 5 %.
  check_within(rest.laguerre[2], heated_a2(e), 0.05 * std::abs(heated_a2(e)));
}

TEST_CASE("direct simulation: below the threshold and within t_c collisions are elastic") {
  const std::vector<double> tau = {10};
  const auto temperature = [&](const Restitution& law) {
    return direct_realization({.law = law}, tau, 5'000, 11, 0).front().temperature;
  };
  CHECK(temperature(ThresholdRestitution{0.5, 100}) == doctest::Approx(2.0 / 3).epsilon(1e-12));
  CHECK(temperature(ContactDurationRestitution{0.5, 1e9}) < 2.0 / 3);  // by the first collisions
  CHECK(temperature(ContactDurationRestitution{0.5, 1e9}) >
        3 * temperature(ConstantRestitution{0.5}));
  CHECK(temperature(PlasticRestitution{100}) == doctest::Approx(2.0 / 3).epsilon(1e-12));
  CHECK(temperature(ThresholdRestitution{0.5, 0}) == temperature(ConstantRestitution{0.5}));
  CHECK(temperature(ViscoelasticRestitution{0.05}) < 2.0 / 3);
}

TEST_CASE("direct simulation: the same seed gives the same bits, another stream gives others") {
  const std::vector<double> tau = {1, 400};
  const HomogeneousGas gas{.law = ConstantRestitution{0.8}};
  const auto one = direct_realization(gas, tau, 500, 3, 0);
  const auto again = direct_realization(gas, tau, 500, 3, 0);
  const auto other = direct_realization(gas, tau, 500, 3, 1);
  CHECK(one[1].laguerre == again[1].laguerre);
  CHECK(one[1].temperature == again[1].temperature);
  CHECK(one[0].laguerre != other[0].laguerre);
  // T falls by exp(-2 gamma_0 400) = 1e-21: it is rescaled on the way, and still finite.
  const double log_ratio = std::log(one[1].temperature / haff_temperature(400, 0.8));
  CHECK(std::abs(log_ratio) < 0.1 * 48);  // 500 particles; a_2 changes 0.4 % of 48
}

TEST_CASE("direct simulation: bad input is refused") {
  const std::vector<double> backwards = {2, 1}, one = {1};
  CHECK_THROWS_AS(direct_realization({}, backwards, 100, 1, 0), std::invalid_argument);
  CHECK_THROWS_AS(direct_realization({}, one, 1, 1, 0), std::invalid_argument);
  CHECK_THROWS_AS(direct_realization({.d = 4}, one, 100, 1, 0), std::invalid_argument);
  CHECK_THROWS_AS(direct_realizations({}, one, {.particles = 100, .realizations = 1}),
                  std::invalid_argument);
  CHECK_THROWS_AS(direct_realization({.law = ViscoelasticRestitution{2}}, one, 1000, 1, 0),
                  std::domain_error);
}
