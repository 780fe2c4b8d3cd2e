// SPDX-License-Identifier: GPL-3.0-or-later

// Clusters placed by hand, and clusters of particles at random positions.
#include "analysis/observables/cluster_sizes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "analysis/particles.hpp"

using namespace haff::analysis;
using doctest::Approx;

TEST_CASE("cluster_sizes: a chain through a face of the box, a pair, and a single particle") {
  const std::vector<Vector> position{{0.5, 5, 5}, {9.5, 5, 5},  {8.45, 5, 5},  // 1.0 and 1.05 apart
                                     {3, 3, 3},   {3, 4.09, 3},                // 1.09 apart
                                     {6, 8, 8}};
  const auto found = cluster_sizes(position, 10);
  CHECK(found.size == std::vector<double>{1, 2, 4});
  CHECK(found.share[0] == Approx(1.0 / 6));
  CHECK(found.share[1] == Approx(5.0 / 6));
  CHECK(found.share[2] == 0);
  CHECK(found.mean == Approx((1 + 4 + 9) / 6.0));
}

TEST_CASE("cluster_sizes: small particles are bonded at their own contact distance") {
  const std::vector<Vector> position{{1, 1, 1}, {1.6, 1, 1}};
  CHECK(cluster_sizes(position, 10).mean == 2);
  CHECK(cluster_sizes(position, 10, 3, [](std::size_t, std::size_t) { return 0.5; }).mean == 1);
}

TEST_CASE("cluster_sizes: the share of single particles at random positions is Poisson's") {
  // The share is exp(-n v), where v is the volume within a bond: 0.6065 of 40 000 particles at n
  // v = 0.5. Both particles of a pair are single or not together, so the variance is less than
  // twice the binomial one. Within 5 standard errors: a false alarm in one of 10^6 seeds.
  for (const int d : {2, 3}) {
    CAPTURE(d);
    Random random(10);
    const std::size_t count = 40000;
    const double v =
        d == 3 ? 4 * std::numbers::pi / 3 * bond * bond * bond : std::numbers::pi * bond * bond;
    const double box = std::pow(static_cast<double>(count) * v / 0.5, 1.0 / d);
    const auto found = cluster_sizes(random_positions(count, box, random), box, d);
    const double p = std::exp(-0.5);
    CHECK(std::abs(found.share[0] - p) <
          5 * std::sqrt(2 * p * (1 - p) / static_cast<double>(count)));
    CHECK(std::accumulate(found.share.begin(), found.share.end(), 0.0) == Approx(1));
  }
}

TEST_CASE("cluster_sizes: no particles are refused, and so is a box narrower than two bonds") {
  CHECK_THROWS_AS(cluster_sizes({}, 10), std::invalid_argument);
  CHECK_THROWS_AS(cluster_sizes(std::vector<Vector>(2), 2.1), std::invalid_argument);
}
