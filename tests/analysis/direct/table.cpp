// SPDX-License-Identifier: GPL-3.0-or-later

// The table of direct simulations, compared with an independent direct simulation.
#include "analysis/direct/table.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "analysis/theory/enskog_boltzmann.hpp"

using namespace haff::analysis;

namespace {

// Both values have an error: `its` is that of the independent value. Four combined errors are a
// false alarm once in 15 000 seeds, and the table does not change by itself.
void check(const TabulatedValue& ours, double independent, double its) {
  INFO(ours.value, " +- ", ours.error, ", independent ", independent, " +- ", its);
  CHECK(std::abs(ours.value - independent) < 4 * std::hypot(ours.error, its));
}

}  // namespace

TEST_CASE("table: e = 0.85 in 3-d agrees with an independent program") {
  // N = 2 10^5, ten seeds, tau > 15.
  check(tabulated("a2", 0.85)->plateau, -0.01688, 7e-5);
  check(tabulated("a3", 0.85)->plateau, -0.00502, 6e-5);
  check(tabulated("a4", 0.85)->plateau, -0.00116, 6e-5);
  check(tabulated("gamma_ratio", 0.85)->plateau, 0.99577, 8e-5);
  const auto a2 = tabulated("a2", 0.85);
  check(a2->at(1), -0.0066, 1.3e-4);
  check(a2->at(3), -0.0130, 1.3e-4);
  check(a2->at(8), -0.0165, 1.3e-4);
  // -A/B differs from it by twenty standard errors.
  CHECK(std::abs(boltzmann_a2_plateau(0.85) - a2->plateau.value) > 1e-3);
}

TEST_CASE("table: an elastic gas has no coefficients") {
  for (const int d : {2, 3}) {
    CAPTURE(d);
    for (const char* name : {"a2", "a3", "a4"})
      CHECK(std::abs(tabulated(name, 1, d)->plateau.value) < 2e-4);
    CHECK(std::abs(tabulated("rate_ratio", 1, d)->plateau.value - 1) < 2e-4);
  }
}

TEST_CASE("table: the first order in a2 falls short, but is right at small 1 - e") {
  // The relative error of the first order falls with 1 - e^2: it is below a tenth at e = 0.98.
  for (const int d : {2, 3}) {
    const auto a2 = tabulated("a2", 0.98, d)->plateau;
    CHECK(std::abs(a2.value - boltzmann_a2_plateau(0.98, d)) <
          4 * a2.error + 0.1 * std::abs(a2.value));
  }
  CHECK(tabulated("a2", 0.7)->plateau.value < 0);
  CHECK(boltzmann_a2_plateau(0.7) > 0);
}

TEST_CASE("table: it follows the exact slope between its points and is constant beyond them") {
  const auto a2 = tabulated("a2", 0.8);
  REQUIRE(a2);
  CHECK(a2->tau.front() == 0);
  const double slope = boltzmann_initial_slopes(0.8).a2;
  CHECK(std::abs(a2->at(0.25).value - 0.25 * slope) < 5 * a2->at(0.25).error);
  CHECK(a2->at(1e6).value == a2->plateau.value);
  CHECK(tabulated_restitutions(2).size() >= 7);
}

TEST_CASE("table: other gases and other quantities are not in it") {
  CHECK_FALSE(tabulated("a2", 0.77));
  CHECK_THROWS_AS(tabulated("a7", 0.8), std::invalid_argument);
}
