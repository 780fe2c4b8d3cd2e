// SPDX-License-Identifier: GPL-3.0-or-later

// The uncorrelated cooling gas: known limits and extrema of the theory.
#include "analysis/theory/enskog_boltzmann.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "support/relative.hpp"

using haff::tests::off;
using namespace haff::analysis;
using doctest::Approx;

namespace {

double e_of_largest_a2(int d) {
  double best = 0.8;
  for (double e = 0.8; e < 1; e += 1e-4) {
    if (std::abs(boltzmann_a2_plateau(e, d)) > std::abs(boltzmann_a2_plateau(best, d))) best = e;
  }
  return best;
}

}  // namespace

TEST_CASE("enskog-boltzmann: a2 starts from zero with slope A and ends on its plateau") {
  for (const int d : {2, 3}) {
    for (const double e : {0.8, 0.9}) {
      const double slope = (e * e - 1) * (2 * e * e - 1) / (d * (d + 2));
      CHECK(boltzmann_a2(0, e, d) == 0);
      CHECK(off(boltzmann_a2(1e-6, e, d) / 1e-6, slope) < 1e-6);  // 1e-6 B/2
      CHECK(boltzmann_a2(1e3, e, d) == Approx(boltzmann_a2_plateau(e, d)).epsilon(1e-12));
    }
  }
}

TEST_CASE("enskog-boltzmann: the plateau vanishes at e = 1 and e = 1/sqrt(2)") {
  for (const int d : {2, 3}) {
    CHECK(boltzmann_a2_plateau(1, d) == 0);
    CHECK(std::abs(boltzmann_a2_plateau(1 / std::numbers::sqrt2, d)) < 1e-15);
    CHECK(boltzmann_a2_plateau(0.9, d) < 0);
    CHECK(boltzmann_a2_plateau(0.5, d) > 0);
  }
}

TEST_CASE("enskog-boltzmann: the plateau is van Noije and Ernst's") {
  // 16 (1-e)(1-2e^2) / (9 + 24d + (8d-41)e + 30 e^2 (1-e)), Granular Matter 1, 57 (1998).
  for (const int d : {2, 3}) {
    for (const double e : {0.2, 0.6, 0.8, 0.95}) {
      const double known =
          16 * (1 - e) * (1 - 2 * e * e) / (9 + 24 * d + (8 * d - 41) * e + 30 * e * e * (1 - e));
      CHECK(boltzmann_a2_plateau(e, d) == Approx(known).epsilon(1e-13));
    }
  }
}

TEST_CASE("enskog-boltzmann: above e = 0.8 the plateau is deepest near 0.865, in 2-d 0.872") {
  CHECK(std::abs(e_of_largest_a2(3) - 0.865) < 6e-4);  // three digits are given, and steps are 1e-4
  CHECK(std::abs(e_of_largest_a2(2) - 0.872) < 6e-4);
}

TEST_CASE("enskog-boltzmann: rates of a Gaussian are Haff's") {
  CHECK(boltzmann_rate_ratio(0) == 1);
  CHECK(boltzmann_gamma_ratio(0) == 1);
  CHECK(boltzmann_gamma_ratio(-0.02) == Approx((1 - 0.00375) / (1 + 0.00125)));
}

TEST_CASE("enskog-boltzmann: a heated gas deviates less from a Gaussian than a cooling one") {
  CHECK(heated_a2(1) == 0);
  CHECK(heated_a2(0.5) > 0);
  CHECK(heated_a2(0.5) < boltzmann_a2_plateau(0.5));
  // 16 * 0.1 * (1 - 1.62) / (73 + 168 - 64.8 - 94.5 + 2.43), evaluated by hand.
  CHECK(heated_a2(0.9) == Approx(-0.992 / 84.13).epsilon(1e-12));
}

TEST_CASE("enskog-boltzmann: the first slope of a2 is A, that of a3 is positive where e is small") {
  for (const int d : {2, 3}) {
    for (const double e : {0.0, 0.5, 0.9})
      CHECK(boltzmann_initial_slopes(e, d).a2 ==
            Approx((e * e - 1) * (2 * e * e - 1) / (d * (d + 2))).epsilon(1e-14));
    CHECK(boltzmann_initial_slopes(1, d).a3 == 0);
  }
  // e = 0 in 3-d, by hand: the mean change of v^6 is J = -(26.25 + 21 + 6) - 2 (7.5 + 6) -
  // 6 = -86.25, so that a_3' = 3/15 - (-86.25/105 + 1).
  CHECK(boltzmann_initial_slopes(0, 3).a3 == Approx(0.2 + 86.25 / 105 - 1).epsilon(1e-14));
}
