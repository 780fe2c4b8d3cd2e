// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/collision_statistics.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

using namespace haff::analysis;
using doctest::Approx;
using Counts = std::vector<std::int64_t>;

TEST_CASE("collision_statistics: a density in bins, with and without a bin for the rest") {
  const auto all = density(Counts{2, 2, 2, 2}, 0.25);
  CHECK(all.x == std::vector{0.125, 0.375, 0.625, 0.875});
  CHECK(all.value == std::vector{1.0, 1.0, 1.0, 1.0});
  const auto most = density_with_rest(Counts{1, 2, 1}, 0.5);
  CHECK(most.x == std::vector{0.25, 0.75});
  CHECK(most.value == std::vector{0.5, 1.0});  // a quarter is beyond the bins
}

TEST_CASE("collision_statistics: no counts give no density, and no bins are refused") {
  CHECK(density(Counts{0, 0}, 0.5).x.empty());
  CHECK(density_of_free_times(Counts{0, 0}, 10, 100).x.empty());
  CHECK_THROWS_AS(density(Counts{}, 0.5), std::invalid_argument);
  CHECK_THROWS_AS(density_of_free_times(Counts{}, 10, 100), std::invalid_argument);
}

TEST_CASE("collision_statistics: bins that hold more whole numbers have no higher density") {
  // One flight of each length k: the density is N/2 over the number of lengths, in every bin. With
  // 7, 33 or 101 particles neighbouring bins hold different numbers of k; with 7 some hold none.
  for (const std::uint32_t particles : {7U, 33U, 101U, 2000U}) {
    CAPTURE(particles);
    Counts counts(101);
    const std::int64_t longest = 12 * particles / 2;
    for (std::int64_t k = 1; k <= longest; ++k)
      ++counts[static_cast<std::size_t>(std::min<std::int64_t>(100, 20 * k / particles))];
    const auto found = density_of_free_times(counts, 10, particles);
    CHECK(found.x.size() <= 100);
    CHECK(found.x.size() >= 34);
    for (std::size_t i = 0; i < found.x.size(); ++i) {
      CHECK(found.value[i] == Approx(0.5 * particles / static_cast<double>(longest)));
      if (i > 0) CHECK(found.x[i] > found.x[i - 1]);
    }
  }
}
