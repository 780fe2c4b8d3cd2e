// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/species.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

using namespace haff::analysis;

TEST_CASE("species: each temperature is that of the species' own particles and mass") {
  const std::vector<std::array<double, 3>> velocities{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  const auto t = species_temperatures(velocities, {false, true, false}, {1, 0.5});
  CHECK(t[0] == doctest::Approx((1.0 + 9.0) / (3 * 2)));
  CHECK(t[1] == doctest::Approx(0.5 * 4.0 / 3));
  CHECK(species_temperatures(velocities, {false, true, false}, {1, 0.5}, 2)[1] ==
        doctest::Approx(0.5 * 4.0 / 2));
}

TEST_CASE("species: a species without particles has no temperature, and lengths must agree") {
  const std::vector<std::array<double, 3>> velocities{{1, 0, 0}};
  CHECK(std::isnan(species_temperatures(velocities, {false}, {1, 1})[1]));
  CHECK_THROWS_AS(species_temperatures(velocities, {}, {1, 1}), std::invalid_argument);
}
