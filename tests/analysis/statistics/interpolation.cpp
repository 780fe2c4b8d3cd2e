// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/statistics/interpolation.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace haff::analysis;

TEST_CASE("interpolation: the line between the neighbouring points, and nothing beyond the ends") {
  const std::vector x{1.0, 2.0, 4.0}, y{10.0, 30.0, -10.0};
  CHECK(*interpolated(x, y, 1) == 10);
  CHECK(*interpolated(x, y, 1.5) == 20);
  CHECK(*interpolated(x, y, 3) == 10);
  CHECK(*interpolated(x, y, 4) == -10);
  CHECK_FALSE(interpolated(x, y, 0.999));
  CHECK_FALSE(interpolated(x, y, 4.001));
  CHECK_FALSE(interpolated({}, {}, 1));
  CHECK_THROWS_AS(interpolated(x, std::vector{1.0}, 2), std::invalid_argument);
}
