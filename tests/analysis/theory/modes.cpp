// SPDX-License-Identifier: GPL-3.0-or-later

// The mode spectrum against its own limits at long waves and against its determinant.
#include "analysis/theory/modes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

#include "analysis/theory/cooling.hpp"
#include "analysis/theory/enskog.hpp"

using namespace haff::analysis;
using doctest::Approx;

TEST_CASE("modes: at k = 0 velocity grows, density stays, temperature decays, all by gamma_0") {
  const Gas gas{.e = 0.9, .n = 0.4};
  const double rate = gamma0(gas.e);
  const ModeSpectrum still = modes(gas, 0);
  CHECK(still.transverse == rate);
  CHECK(still.longitudinal[0].real() == Approx(rate));
  CHECK(std::abs(still.longitudinal[1]) < 1e-15);
  CHECK(still.longitudinal[2].real() == Approx(-rate));
}

TEST_CASE("modes: long longitudinal waves grow as gamma_0 (1 - xi_par^2 k^2)") {
  for (const int d : {2, 3}) {
    for (const double e : {0.8, 0.9}) {
      const Gas gas{.e = e, .n = 0.4, .d = d};
      const Lengths length = lengths(gas);
      const double rate = gamma0(e, d);
      const double k = 1e-3 * rate / length.free_path;
      // Next order (k l_0 / gamma_0)^2 = 1e-6; rounding 1e-16 / (xi k)^2 ~ 1e-9.
      const double slope = (1 - modes(gas, k).longitudinal[0].real() / rate) / (k * k);
      CHECK(slope == Approx(length.longitudinal * length.longitudinal).epsilon(2e-5));
    }
  }
}

TEST_CASE("modes: short waves are two damped sound waves and damped heat") {
  const Gas gas{.e = 0.9, .n = 0.4};
  // k is ten times gamma_0/l_0, where sound propagates and all modes are stable.
  const ModeSpectrum s = modes(gas, 10 * gamma0(gas.e) / lengths(gas).free_path);
  int waves = 0;
  for (const auto& mode : s.longitudinal) {
    CHECK(mode.real() < 0);
    if (std::abs(mode.imag()) > 1e-6) ++waves;
  }
  CHECK(waves == 2);
}

TEST_CASE("modes: each bound is where its mode neither grows nor decays") {
  for (const int d : {2, 3}) {
    const Gas gas{.e = 0.85, .n = 0.3, .d = d};
    const InstabilityBounds bound = instability_bounds(gas);
    CHECK(bound.shear == Approx(1 / lengths(gas).transverse));
    CHECK(std::abs(modes(gas, bound.shear).transverse) < 1e-15);
    REQUIRE(bound.heat > 0);
    const auto slowest = [&](double k) {
      double nearest = 1;
      for (const auto& mode : modes(gas, k).longitudinal) {
        if (std::abs(mode) < std::abs(nearest)) nearest = mode.real();
      }
      return nearest;
    };
    CHECK(std::abs(slowest(bound.heat)) < 1e-13);
    CHECK(slowest(0.99 * bound.heat) > 0);
    CHECK(slowest(1.01 * bound.heat) < 0);
  }
}
