// SPDX-License-Identifier: GPL-3.0-or-later

// Coarse-grained fields of particles placed by hand, and the correction of the local temperature.
#include "analysis/observables/coarse_grained.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

#include "analysis/particles.hpp"

using namespace haff::analysis;
using doctest::Approx;

TEST_CASE("coarse-grained: three particles by hand") {
  // A box of 2 x 2 x 2 cells of side 5: two particles in (0, 0, 1), one in (1, 0, 0).
  const std::vector<Vector> position = {{1, 1, 9}, {4, 4, 6}, {9.9, 0, 0}};
  const std::vector<Vector> velocity = {{1, 0, 0}, {3, 0, 4}, {7, 8, 9}};
  const auto field = coarse_grained(position, velocity, 10, 2);
  REQUIRE(field.density.size() == 8);
  REQUIRE(field.velocity.size() == 24);
  CHECK(field.density[1] == 2.0 / 125);
  CHECK(field.density[4] == 1.0 / 125);
  CHECK(field.density[0] == 0);
  CHECK(field.velocity[3] == 2);
  CHECK(field.velocity[5] == 2);
  CHECK(field.velocity[12] == 7);
  CHECK(std::isnan(field.velocity[0]));
  // Deviations (-1, 0, -2) and (1, 0, 2): 10 in all over d (N_r - 1) = 3.
  CHECK(field.temperature[1] == Approx(10.0 / 3).epsilon(1e-15));
  CHECK(std::isnan(field.temperature[4]));
  CHECK(std::isnan(field.temperature[0]));
}

TEST_CASE("coarse-grained: a planar gas has planar cells") {
  const std::vector<Vector> position = {{1, 9, 0}, {4, 6, 0}};
  const std::vector<Vector> velocity = {{1, 5, 99}, {3, 5, 0}};
  const auto field = coarse_grained(position, velocity, 10, 2, 2);
  REQUIRE(field.velocity.size() == 8);
  CHECK(field.velocity[2] == 2);
  CHECK(field.velocity[3] == 5);
  CHECK(field.temperature[1] == 1);  // 2 / (2 (2 - 1))
  CHECK(field.density[1] == 2.0 / 25);
}

TEST_CASE("coarse-grained: the local temperature has no bias from few particles") {
  // T = 1 with some 4 particles per cell; without the correction the mean would be near 0.75. The
  // mean of 8000 cells, weighted by their degrees of freedom, has the standard error sqrt(2 / (3 (N
  // - cells))) = 0.0053. Within 4.5 of them: a false alarm in one of 150 000 seeds.
  Random random(7);
  constexpr std::size_t count = 32000;
  const auto field = coarse_grained(random_positions(count, 20, random),
                                    thermal_velocities(count, random), 20, 20);
  double sum = 0, freedom = 0;
  for (std::size_t c = 0; c < field.temperature.size(); ++c) {
    if (std::isnan(field.temperature[c])) continue;
    sum += field.temperature[c] * (field.density[c] - 1);  // cells of volume 1
    freedom += field.density[c] - 1;
  }
  CHECK(std::abs(sum / freedom - 1) < 4.5 * std::sqrt(2 / (3 * freedom)));
}

TEST_CASE("coarse-grained: the paper's cells where there are enough particles") {
  CHECK(coarse_cells(1e6) == 32);
  CHECK(coarse_cells(6e5) == 32);
  CHECK(coarse_cells(32000) == 16);
  CHECK(coarse_cells(3) == 1);
  CHECK(coarse_cells(6e5, 2) == 32);
}

TEST_CASE("coarse-grained: positions without velocities are refused") {
  const std::vector<Vector> one(1), two(2);
  CHECK_THROWS_AS(coarse_grained(one, two, 10, 2), std::invalid_argument);
}
