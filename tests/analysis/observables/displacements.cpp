// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/displacements.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

#include "analysis/particles.hpp"

using namespace haff::analysis;
using doctest::Approx;

TEST_CASE("displacements: two particles by hand") {
  const std::vector<Vector> before{{0, 0, 0}, {1, 1, 1}}, now{{3, 4, 0}, {1, 1, 3}};
  CHECK(mean_square_displacement(now, before) == Approx((25 + 4) / 2.0));
  CHECK(mean_square_displacement(now, now) == 0);
}

TEST_CASE("displacements: velocities correlate with themselves, however the gas has cooled") {
  Random random(14);
  const auto before = thermal_velocities(100, random);
  auto now = before;
  for (Vector& v : now)
    for (double& x : v) x *= 1e-3;
  CHECK(velocity_autocorrelation(now, before) == Approx(1).epsilon(1e-14));
  for (Vector& v : now)
    for (double& x : v) x = -x;
  CHECK(velocity_autocorrelation(now, before) == Approx(-1).epsilon(1e-14));
  CHECK(velocity_autocorrelation(std::vector<Vector>(100), before) == 0);
  CHECK_THROWS_AS(velocity_autocorrelation(now, {}), std::invalid_argument);
  CHECK_THROWS_AS(mean_square_displacement({}, {}), std::invalid_argument);
}
