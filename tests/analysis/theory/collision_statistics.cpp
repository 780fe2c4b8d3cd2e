// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/theory/collision_statistics.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>

using namespace haff::analysis;
using doctest::Approx;

namespace {

// int_0^60 of u^power p(u), by Simpson's rule: the rest is of order exp(-0.7 * 60).
double moment(int power, int d) {
  constexpr int steps = 6000;
  constexpr double width = 60.0 / steps;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double u = i * width;
    sum += std::pow(u, power) * free_time_density(u, d) *
           (i == 0 || i == steps ? 1
            : i % 2 == 1         ? 4
                                 : 2);
  }
  return sum * width / 3;
}

}  // namespace

TEST_CASE(
    "collision_statistics: a particle at rest is hit less often, a fast one in proportion to its "
    "speed") {
  // At rest the rate is <|c'|>/<|c - c'|> = 1/sqrt(2) in any dimension; for large c it is c/<|c -
  // c'|>.
  CHECK(relative_collision_rate(0, 3) == Approx(1 / std::numbers::sqrt2).epsilon(1e-12));
  CHECK(relative_collision_rate(0, 2) == Approx(1 / std::numbers::sqrt2).epsilon(1e-12));
  CHECK(relative_collision_rate(1e-4) == Approx(relative_collision_rate(0.99e-4)).epsilon(1e-8));
  CHECK(relative_collision_rate(50, 3) ==
        Approx(50 / std::sqrt(8 / std::numbers::pi)).epsilon(1e-3));
  CHECK(relative_collision_rate(50, 2) ==
        Approx(50 / std::sqrt(std::numbers::pi / 2)).epsilon(1e-3));
}

TEST_CASE("collision_statistics: free times have the mean 1 and are not exponential") {
  for (const int d : {2, 3}) {
    CAPTURE(d);
    CHECK(moment(0, d) == Approx(1).epsilon(1e-7));
    CHECK(moment(1, d) == Approx(1).epsilon(1e-7));
    // An exponential would give 1 and 2. <r^2> = p(0).
    CHECK(free_time_density(0, d) > 1.04);
    CHECK(moment(2, d) > 2.07);
  }
  // Long free times are those of slow particles: exp(-u/sqrt(2)) times a power of u.
  const double slope = std::log(free_time_density(60) / free_time_density(61));
  CHECK(slope > 1 / std::numbers::sqrt2);
  CHECK(slope < 0.75);
}

TEST_CASE("collision_statistics: normal speeds") {
  double sum = 0, mean = 0;
  for (int i = 0; i < 1000; ++i) {
    const double w = (i + 0.5) / 100;
    sum += normal_speed_density(w) / 100;
    mean += w * normal_speed_density(w) / 100;
  }
  CHECK(sum == Approx(1).epsilon(1e-4));
  CHECK(mean == Approx(std::sqrt(std::numbers::pi / 2)).epsilon(1e-4));
}
