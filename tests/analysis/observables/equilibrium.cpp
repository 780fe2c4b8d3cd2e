// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/equilibrium.hpp"

#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "analysis/observables/moments.hpp"

using namespace haff::analysis;

TEST_CASE("equilibrium: a_l of few particles at fixed energy and momentum") {
  // Two particles have equal speeds, c^2 = 3/2, so a_l = l! Gamma(3/2)/Gamma(l+3/2) L_l(3/2).
  CHECK(equilibrium_laguerre(2, 2) == doctest::Approx(-2.0 / 5));
  CHECK(equilibrium_laguerre(2, 100) == doctest::Approx(-2.0 / (3 * 99 + 2)));
  CHECK(equilibrium_laguerre(0, 5) == 1);
  CHECK(equilibrium_laguerre(1, 5) == doctest::Approx(0));
  const LaguerreCoefficients equal =
      moments(std::vector<std::array<double, 3>>{{1, 0, 0}, {-1, 0, 0}}).laguerre;
  CHECK(equilibrium_laguerre(3, 2) == doctest::Approx(equal[3]));
  CHECK(equilibrium_laguerre(4, 2) == doctest::Approx(equal[4]));
}

TEST_CASE("equilibrium: Gaussian coefficients pass, others or missing ones do not") {
  // 0.06 is 5 standard errors of a_2, sqrt(8/(15 N)) = 0.0115.
  CHECK(is_equilibrated({0.0, 0.0, 0.0}, 4000));
  CHECK_FALSE(is_equilibrated({0.06, 0.0, 0.0}, 4000));
  CHECK_FALSE(is_equilibrated({std::nullopt, 0.0, 0.0}, 4000));
}
