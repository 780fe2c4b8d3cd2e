// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/theory/spectrum.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/theory/cooling.hpp"
#include "analysis/theory/enskog.hpp"

using namespace haff::analysis;
using doctest::Approx;

TEST_CASE("spectrum: long waves keep their energy, short ones cool with the gas") {
  const Gas gas{.e = 0.8, .n = 0.4, .d = 3};
  const double s = 2 * gamma0(0.8) * 20;
  CHECK(spectrum_ratio(gas, 1e-6, 20, false) == Approx(std::exp(s)).epsilon(1e-6));
  CHECK(spectrum_ratio(gas, 1e4, 20, false) == Approx(1).epsilon(1e-6));
  CHECK(spectrum_ratio(gas, 0.3, 0, true) == 1);
  // At k = 1/xi growth and noise balance: 1 + s.
  const double xi = lengths(gas).transverse;
  CHECK(spectrum_ratio(gas, 1 / xi, 20, false) == Approx(1 + s).epsilon(1e-6));
}

TEST_CASE("spectrum: equilibrium energy of a mode is T/2 for each direction") {
  const double k = 0.7, n = 0.4, particles = 1000;
  const double modes =
      particles / n * 4 * std::acos(-1.0) * k * k / std::pow(2 * std::acos(-1.0), 3);
  CHECK(equilibrium_spectrum(k, n, 0.5, true) * particles == Approx(modes * 0.25));
  CHECK(equilibrium_spectrum(k, n, 0.5, false) ==
        Approx(2 * equilibrium_spectrum(k, n, 0.5, true)));
  CHECK(equilibrium_spectrum(k, n, 0.5, false, 2) ==
        Approx(equilibrium_spectrum(k, n, 0.5, true, 2)));
}
