// SPDX-License-Identifier: GPL-3.0-or-later

// Temperature and Laguerre coefficients of arrays whose distribution is known.
#include "analysis/observables/moments.hpp"

#include <doctest/doctest.h>
#include <gsl/gsl_sf_laguerre.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "support/random.hpp"

using namespace haff::analysis;
using Vector = std::array<double, 3>;

namespace {

std::vector<Vector> gaussian_velocities(std::size_t count, std::uint64_t seed) {
  haff::tests::Normal next{seed};
  std::vector<Vector> v(count);
  for (auto& each : v) each = {next(), next(), next()};
  return v;
}

}  // namespace

TEST_CASE("moments: the Laguerre coefficients of a Gaussian are zero within their noise") {
  constexpr std::size_t count = 200000;
  const auto velocity = gaussian_velocities(count, 7);
  for (const int d : {2, 3}) {
    const auto m = moments(velocity, d);
    // Five standard errors: one false alarm in 10^6.
    CHECK(std::abs(m.temperature - 1) < 5 * std::sqrt(2.0 / (d * double(count))));
    for (int l = 2; l <= highest_laguerre; ++l) {
      CHECK(std::abs(m.laguerre[std::size_t(l)]) < 5 * laguerre_noise(l, double(count), d));
    }
  }
}

TEST_CASE("moments: a_0 is one and a_1 zero whatever the velocities") {
  const std::vector<Vector> odd = {{1, 2, 3}, {-4, 0.1, 0}, {1e3, -7, 2}};
  for (const int d : {2, 3}) {
    const auto a = moments(odd, d).laguerre;
    CHECK(a[0] == 1);
    CHECK(a[1] == 0);
  }
}

TEST_CASE("moments: coefficients are averages of Laguerre polynomials") {
  const auto velocity = gaussian_velocities(1003, 3);
  for (const int d : {2, 3}) {
    const auto m = moments(velocity, d);
    double norm = 1;  // l! Gamma(d/2) / Gamma(l + d/2)
    for (int l = 1; l <= highest_laguerre; ++l) {
      norm *= l / (0.5 * d + l - 1);
      double mean = 0;
      for (const auto& v : velocity) {
        const double v2 = v[0] * v[0] + v[1] * v[1] + (d == 3 ? v[2] * v[2] : 0);
        mean += gsl_sf_laguerre_n(l, 0.5 * d - 1, v2 / (2 * m.temperature));
      }
      mean *= norm / double(velocity.size());
      // The rounding error of the plain sum, whose polynomials are as large as 10^3.
      CHECK(std::abs(m.laguerre[std::size_t(l)] - mean) < 1e-11);
    }
  }
}

TEST_CASE("moments: equal speeds have a_2 = -2/5 in three dimensions and -1/2 in two") {
  const std::vector<Vector> sphere = {{2, 0, 0}, {0, 2, 0}, {0, 0, -2}};
  const std::vector<Vector> circle = {{2, 0, 9}, {0, -2, 9}};  // the third component is ignored
  CHECK(moments(sphere, 3).laguerre[2] == doctest::Approx(-0.4).epsilon(1e-14));
  CHECK(moments(circle, 2).laguerre[2] == doctest::Approx(-0.5).epsilon(1e-14));
  CHECK(moments(circle, 2).temperature == 2);
}

TEST_CASE("moments: an exponential tail gives the coefficients of its moments") {
  // rho ~ exp(-b c) in 3-d: <c^2k> = (2k+2)! / (2 b^2k), b^2 = 8 so that <c^2> = 3/2.
  LaguerreCoefficients c_moments{};
  double factorial = 2;
  for (std::size_t k = 0; k < c_moments.size(); ++k) {
    c_moments[k] = factorial / (2 * std::pow(8.0, double(k)));
    factorial *= double(2 * k + 3) * double(2 * k + 4);
  }
  const auto a = laguerre_from_moments(c_moments, 3);
  // M_k = 1, 1, 1.5, 3, 7.5, 22.5, 78.75 in units of the Gaussian values.
  const LaguerreCoefficients known = {1, 0, 0.5, -0.5, 1.5, -4, 13.75};
  for (std::size_t l = 0; l < a.size(); ++l) CHECK(std::abs(a[l] - known[l]) < 1e-12);
}

TEST_CASE("moments: scaling velocities by a power of two changes no digit") {
  auto velocity = gaussian_velocities(5000, 11);
  const auto before = moments(velocity);
  for (auto& v : velocity) {
    for (auto& x : v) x *= 0x1p-40;
  }
  const auto after = moments(velocity);
  CHECK(after.temperature == before.temperature * 0x1p-80);
  CHECK(after.laguerre == before.laguerre);
}

TEST_CASE("moments: sums are good to a few units in the last place") {
  // 10^6 equal velocities: all results are known exactly.
  const std::vector<Vector> velocity(1000003, Vector{0.1, 0.1, 0.1});
  const auto m = moments(velocity);
  CHECK(m.temperature == doctest::Approx(0.01).epsilon(1e-13));
  CHECK(m.laguerre[2] == doctest::Approx(-0.4).epsilon(1e-12));
}

TEST_CASE("moments: an empty array is refused, and so is an unknown dimension") {
  CHECK_THROWS_AS(moments({}), std::invalid_argument);
  const std::vector<Vector> one = {{1, 0, 0}};
  CHECK_THROWS_AS(moments(one, 4), std::invalid_argument);
}

TEST_CASE("moments: a gas at rest has temperature zero and no coefficients") {
  const std::vector<Vector> rest(3, Vector{0, 0, 0});
  const auto m = moments(rest);
  CHECK(m.temperature == 0);
  CHECK(std::isnan(m.laguerre[2]));
}
