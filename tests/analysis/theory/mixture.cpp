// SPDX-License-Identifier: GPL-3.0-or-later

// The uncorrelated cooling mixture: limits in which the results are known.
#include "analysis/theory/mixture.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "analysis/theory/enskog.hpp"
#include "support/relative.hpp"

using haff::tests::off;
using namespace haff::analysis;
using doctest::Approx;

TEST_CASE("mixture: with equal spheres it is the gas of one species") {
  const BinaryMixture gas{.e = 0.8, .n = 0.4, .fraction = 0.3};
  CHECK(packing_fraction(gas) == Approx(packing_fraction(0.4)).epsilon(1e-14));
  for (const int i : {1, 2}) {
    CHECK(contact_value(gas, i, 2) == Approx(contact_value(0.4)).epsilon(1e-14));
    // Haff: d ln T/dt = -(1 - e^2)/3 omega_0.
    CHECK(cooling_rate(gas, i, 0.7, 0.7) ==
          Approx((1 - 0.64) / 3 * transport(0.4, 0.7).collision_rate).epsilon(1e-12));
  }
  CHECK(temperature_ratio(gas) == Approx(1).epsilon(1e-9));
}

TEST_CASE("mixture: with equal disks it is the gas of one species") {
  const BinaryMixture gas{.e = 0.8, .n = 0.4, .fraction = 0.3, .d = 2};
  CHECK(packing_fraction(gas) == Approx(packing_fraction(0.4, 2)).epsilon(1e-14));
  for (const int i : {1, 2}) {
    CHECK(contact_value(gas, i, 2) == Approx(contact_value(0.4, 2)).epsilon(1e-14));
    // Haff: d ln T/dt = -(1 - e^2)/2 omega_0, with omega_0 = 2 sqrt(pi T) n chi.
    CHECK(
        cooling_rate(gas, i, 0.7, 0.7) ==
        Approx((1 - 0.64) / 2 * 2 * std::sqrt(std::numbers::pi * 0.7) * 0.4 * contact_value(0.4, 2))
            .epsilon(1e-12));
  }
}

TEST_CASE("mixture: noise heats the heavier species more, and both balance their losses") {
  for (const int d : {2, 3}) {
    const BinaryMixture gas{.e = 0.9, .n = 0.1, .diameter_ratio = 1, .mass_ratio = 0.2, .d = d};
    const double ratio = heated_temperature_ratio(gas);
    CHECK(ratio > temperature_ratio(gas));
    CHECK(cooling_rate(gas, 1, ratio, 1) * ratio ==
          Approx(cooling_rate(gas, 2, ratio, 1) / 0.2).epsilon(1e-9));
  }
  CHECK(heated_temperature_ratio({.e = 0.8, .n = 0.4, .fraction = 0.3}) == Approx(1).epsilon(1e-9));
}

TEST_CASE("mixture: elastic spheres of any kind have one temperature, and keep it") {
  const BinaryMixture gas{
      .e = 1, .n = 0.3, .fraction = 0.6, .diameter_ratio = 0.4, .mass_ratio = 0.1};
  CHECK(temperature_ratio(gas) == Approx(1).epsilon(1e-9));
  CHECK(std::abs(cooling_rate(gas, 1, 1, 1)) < 1e-14);  // rates are of order one
  // Out of equilibrium energy passes from one species to the other, and none is lost.
  const double lost = 0.4 * 2 * cooling_rate(gas, 1, 2, 1) + 0.6 * 1 * cooling_rate(gas, 2, 2, 1);
  CHECK(std::abs(lost) < 1e-14);
  CHECK(cooling_rate(gas, 1, 2, 1) > 0.01);
}

TEST_CASE("mixture: the heavier species is warmer, the more so at smaller e") {
  double before = 1;
  for (const double e : {0.95, 0.9, 0.8, 0.7}) {
    const double ratio = temperature_ratio(
        {.e = e, .n = 0.1, .fraction = 0.5, .diameter_ratio = 1, .mass_ratio = 0.1});
    CHECK(ratio > before);
    before = ratio;
    // With the species exchanged the ratio is the inverse.
    const double inverse = temperature_ratio(
        {.e = e, .n = 0.1, .fraction = 0.5, .diameter_ratio = 1, .mass_ratio = 10});
    CHECK(ratio * inverse == Approx(1).epsilon(1e-9));
  }
}

TEST_CASE("mixture: the ratio does not depend on which species is called 1") {
  const BinaryMixture gas{
      .e = 0.8, .n = 0.2, .fraction = 0.3, .diameter_ratio = 0.5, .mass_ratio = 0.2};
  // In units of the smaller sphere.
  const BinaryMixture same{
      .e = 0.8, .n = 0.2 / 8, .fraction = 0.7, .diameter_ratio = 2, .mass_ratio = 5};
  CHECK(packing_fraction(gas) == Approx(packing_fraction(same)).epsilon(1e-14));
  CHECK(temperature_ratio(gas) * temperature_ratio(same) == Approx(1).epsilon(1e-9));
}
