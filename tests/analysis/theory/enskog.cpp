// SPDX-License-Identifier: GPL-3.0-or-later

// Transport coefficients and lengths of the elastic fluid against numbers from an independent
// calculation at n = 0.40, good to the digits given, and against limits known exactly.
#include "analysis/theory/enskog.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <stdexcept>

#include "analysis/theory/cooling.hpp"
#include "support/relative.hpp"

using haff::tests::off;
using namespace haff::analysis;
using doctest::Approx;

namespace {
constexpr double n = 0.40;
constexpr double digits = 5.1e-5;  // half of the last digit given
}  // namespace

TEST_CASE("enskog: contact value, collision rate and viscosities at n = 0.40") {
  CHECK(std::abs(contact_value(n) - 1.8120) < digits);
  const Transport fluid = transport(n, 1);
  CHECK(std::abs(fluid.collision_rate - 5.1386) < digits);
  CHECK(std::abs(fluid.viscosity / n - 0.9809) < digits);
  CHECK(std::abs(fluid.bulk_viscosity - 0.22838) < digits / 10);
}

TEST_CASE("enskog: correlation lengths at n = 0.40") {
  CHECK(std::abs(lengths({.e = 0.80, .n = n}).transverse - 1.7837) < digits);
  CHECK(std::abs(lengths({.e = 0.90, .n = n}).transverse - 2.4552) < digits);
  CHECK(std::abs(lengths({.e = 0.80, .n = n}).longitudinal - 6.0963) < digits);
  CHECK(std::abs(lengths({.e = 0.90, .n = n}).longitudinal - 11.0947) < digits);
}

TEST_CASE("enskog: coefficients are proportional to sqrt(T), and lengths do not depend on T") {
  for (const int d : {2, 3}) {
    const Transport cold = transport(n, 0.25, d), warm = transport(n, 1, d);
    CHECK(warm.collision_rate == Approx(2 * cold.collision_rate));
    CHECK(warm.viscosity == Approx(2 * cold.viscosity));
    CHECK(warm.bulk_viscosity == Approx(2 * cold.bulk_viscosity));
    CHECK(warm.conductivity == Approx(2 * cold.conductivity));
  }
}

TEST_CASE("enskog: the dilute gas is Boltzmann's") {
  constexpr double dilute = 1e-6;
  const double thermal = 1 / std::sqrt(std::numbers::pi);
  const Transport spheres = transport(dilute, 1, 3), disks = transport(dilute, 1, 2);
  // Density corrections are of order n; Sonine corrections are Chapman and Cowling's.
  CHECK(off(spheres.viscosity, 1.016 * 5 / 16 * thermal) < 1e-5);
  CHECK(off(spheres.conductivity, 1.025 * 75 / 64 * thermal) < 1e-5);
  CHECK(off(disks.viscosity, 1.022 / 2 * thermal) < 1e-5);
  CHECK(off(disks.conductivity, 1.029 * 2 * thermal) < 1e-5);
  // The Prandtl number (specific heat at constant pressure)*eta/kappa is 2/3 in space and 1/2 in
  // the plane to first order in Sonine polynomials, hence the tolerance of 1 %.
  CHECK(off(2.5 * spheres.viscosity / spheres.conductivity, 2.0 / 3) < 0.01);
  CHECK(off(2 * disks.viscosity / disks.conductivity, 0.5) < 0.01);
  CHECK(off(spheres.collision_rate, 4 * std::sqrt(std::numbers::pi) * dilute) < 1e-5);
}

TEST_CASE("enskog: collisional transfer has the form of the first Sonine approximation") {
  // kappa = kappa_B [(1 + c phi chi)^2 / chi + ...], V. Garzo and J. W. Dufty, PRE 59, 5895 (1999):
  // c = 3 2^(d-1) / (d + 2), and the rest is twice the heat capacity times the bulk viscosity,
  // without the Sonine correction. The constants of the table are rounded to three or four digits:
  // 0.757 is good to 7e-4, in a term that is a third of the sum.
  for (const int d : {2, 3}) {
    const double phi = packing_fraction(n, d), chi = contact_value(n, d);
    const Transport fluid = transport(n, 1, d);
    const double boltzmann = (d == 2 ? 1.029 * 2 : 1.025 * 75 / 64) / std::sqrt(std::numbers::pi);
    const double c = 3.0 * (d == 2 ? 2 : 4) / (d + 2);
    const double kinetic = boltzmann * std::pow(1 + c * phi * chi, 2) / chi;
    CHECK(off(fluid.conductivity, kinetic + d / 2.0 * fluid.bulk_viscosity) < 3e-4);
  }
}

TEST_CASE("enskog: g and the stiffness are derivatives of the equation of state") {
  constexpr double h = 1e-6;  // central difference: error h^2 and rounding / h, both below 1e-9
  for (const int d : {2, 3}) {
    const EquationOfState here = equation_of_state(n, d);
    const auto rate = [&](double at) { return std::log(transport(at, 1, d).collision_rate); };
    CHECK(here.g == Approx(n * (rate(n + h) - rate(n - h)) / (2 * h)).epsilon(1e-8));
    const auto p = [&](double at) { return at * equation_of_state(at, d).z; };
    CHECK(here.stiffness == Approx((p(n + h) - p(n - h)) / (2 * h)).epsilon(1e-8));
  }
}

TEST_CASE("enskog: spheres obey the Carnahan-Starling equation of state") {
  const double phi = packing_fraction(n);
  const double z = (1 + phi + phi * phi - phi * phi * phi) / std::pow(1 - phi, 3);
  CHECK(equation_of_state(n).z == Approx(z).epsilon(1e-14));
}

TEST_CASE("enskog: bad input is refused") {
  CHECK_THROWS_AS(lengths({.e = 1, .n = n}), std::invalid_argument);
  CHECK_THROWS_AS(contact_value(2.0), std::invalid_argument);
  CHECK_THROWS_AS(contact_value(n, 4), std::invalid_argument);
}

TEST_CASE("enskog: disks have Henderson's pressure, z = (1 + phi^2/8) / (1 - phi)^2") {
  for (const double density : {0.05, 0.4, 0.8}) {
    const double phi = packing_fraction(density, 2);
    CHECK(equation_of_state(density, 2).z ==
          Approx((1 + phi * phi / 8) / ((1 - phi) * (1 - phi))).epsilon(1e-14));
  }
  // The third virial coefficient, 3.125 phi^2, is exact to a thousandth: 16/3 - 4 sqrt(3)/pi
  // (L. Tonks, Phys. Rev. 50, 955 (1936)).
  const double exact = 16.0 / 3 - 4 * std::numbers::sqrt3 / std::numbers::pi;
  CHECK(off(3.125, exact) < 1e-3);
}
