// SPDX-License-Identifier: GPL-3.0-or-later

// g(r) of particles at random positions, on a lattice, and by brute force.
// tests/validate/observables.cpp has g(r) of an elastic gas.
#include "analysis/observables/pair_distribution.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "analysis/particles.hpp"

using namespace haff::analysis;
using doctest::Approx;

TEST_CASE("pair_distribution: g = 1 for particles at random positions, also at contact") {
  // With 20 000 particles in a box of 40, a bin holds at least 390 pairs in the plane and 12 000 in
  // space; 60 bins within 4.5 standard errors: a false alarm in one of 2500 seeds. The variance of
  // chi is that of the header.
  for (const int d : {2, 3}) {
    CAPTURE(d);
    Random random(5);
    const double box = 40;
    const std::size_t count = d == 3 ? 20000 : 2000;
    auto position = random_positions(count, box, random);
    const auto all = pair_distribution(position, box, d);
    REQUIRE(all.r.size() == 61);
    CHECK(all.r[0] == 1);
    CHECK(all.r[1] == Approx(1.025));
    const auto particles = static_cast<double>(count);
    const double n = particles / std::pow(box, d);
    for (std::size_t b = 1; b < all.g.size(); ++b) {
      const double low = all.r[b] - 0.025, high = all.r[b] + 0.025;
      const double shell = d == 3
                               ? 4 * std::numbers::pi / 3 * (std::pow(high, 3) - std::pow(low, 3))
                               : std::numbers::pi * (high * high - low * low);
      CHECK(std::abs(all.g[b] - 1) < 4.5 / std::sqrt(0.5 * particles * n * shell));
    }
    const double surface = d == 3 ? 4 * std::numbers::pi : 2 * std::numbers::pi;
    CHECK(std::abs(all.g[0] - 1) <
          4.5 * std::sqrt(16 / (contact_range * n * surface * particles / 2)));
  }
}

TEST_CASE("pair_distribution: the pairs within and between two species are all pairs") {
  Random random(6);
  const auto all = random_positions(3000, 20, random);
  const std::vector<Vector> one(all.begin(), all.begin() + 1000),
      other(all.begin() + 1000, all.end());
  const auto a = pair_distribution(one, 20), b = pair_distribution(other, 20),
             both = pair_distribution(one, other, 20, 1), whole = pair_distribution(all, 20);
  const double of_a = 1000 * 999 / 2, of_b = 2000.0 * 1999 / 2, of_both = 1000 * 2000;
  for (std::size_t i = 0; i < whole.g.size(); ++i)
    CHECK(of_a * a.g[i] + of_b * b.g[i] + of_both * both.g[i] ==
          Approx((of_a + of_b + of_both) * whole.g[i]).epsilon(1e-10));
}

TEST_CASE("pair_distribution: neighbours on a lattice, also through the faces of the box") {
  // 6 neighbours at 1.52, inside a bin, and 12 at 2.15: 3 N and 6 N pairs.
  const auto position = lattice(10, 15.2, 3);
  const auto found = pair_distribution(position, 15.2);
  const double density = 1000.0 * 999 / 2 / std::pow(15.2, 3);
  const auto pairs = [&](std::size_t bin) {
    const double low = 1 + 0.05 * static_cast<double>(bin), high = low + 0.05;
    return found.g[bin + 1] * density * 4 * std::numbers::pi / 3 *
           (std::pow(high, 3) - std::pow(low, 3));
  };
  CHECK(pairs(10) == Approx(3000));  // 1.50 to 1.55
  CHECK(pairs(9) == 0);
  CHECK(pairs(22) == Approx(6000));  // 2.10 to 2.15: 1.52 sqrt(2) = 2.1496
  CHECK(found.g[0] == 0);            // none near contact
}

TEST_CASE("pair_distribution: a small box has no cells, but the same pairs") {
  Random random(7);
  // The reach is 2 in a box of 4; compared with brute force.
  const auto position = random_positions(200, 4, random);
  const auto found = pair_distribution(position, 4);
  REQUIRE(found.r.size() == 21);
  double pairs = 0;
  for (std::size_t i = 0; i < position.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      double square = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        double x = position[i][k] - position[j][k];
        x -= 4 * std::nearbyint(x / 4);
        square += x * x;
      }
      if (square > 1 && square < 4) ++pairs;
    }
  double summed = 0;
  for (std::size_t b = 1; b < found.g.size(); ++b)
    summed += found.g[b] * 200.0 * 199 / 2 / 64 * 4 * std::numbers::pi / 3 *
              (std::pow(found.r[b] + 0.025, 3) - std::pow(found.r[b] - 0.025, 3));
  CHECK(summed == Approx(pairs));
}

TEST_CASE("pair_distribution: a shorter reach leaves out bins and does not change the others") {
  Random random(8);
  const auto position = random_positions(2000, 15, random);
  const auto all = pair_distribution(position, 15);
  const auto near = pair_distribution(position, 15, 3, 1, 1 + contact_range);
  REQUIRE(near.r.size() == 9);
  for (std::size_t i = 0; i < near.r.size(); ++i) {
    CHECK(near.r[i] == all.r[i]);
    CHECK(near.g[i] == Approx(all.g[i]).epsilon(1e-12));
  }
}

TEST_CASE("pair_distribution: all pairs are counted but the one that has just collided") {
  std::vector<Vector> position{{1, 1, 1}, {2, 1, 1}, {5, 5, 5}, {6 + 1e-7, 5, 5}};
  const auto both = pair_distribution(position, 10);
  position.resize(2);
  for (const double r : {1 - 1e-12, 1.0, 1 + 1e-12}) {
    position[1][0] = position[0][0] + r;
    const auto touching = pair_distribution(position, 10);
    CHECK(touching.g[0] == 0);
    CHECK(touching.g[1] == 0);
  }
  CHECK(both.g[0] > 0);
  CHECK(both.g[1] > 0);
}

TEST_CASE("pair_distribution: bad input is refused") {
  CHECK_THROWS_AS(pair_distribution(std::vector<Vector>(5), 3.9), std::invalid_argument);
  CHECK_THROWS_AS(pair_distribution(std::vector<Vector>(1), 10), std::invalid_argument);
  CHECK_THROWS_AS(pair_distribution({}, std::vector<Vector>(1), 10, 1), std::invalid_argument);
}
