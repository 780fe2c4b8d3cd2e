// SPDX-License-Identifier: GPL-3.0-or-later

// The tail of distributions that are known.
#include "analysis/observables/tail.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "analysis/particles.hpp"

using namespace haff::analysis;
using doctest::Approx;

namespace {

// Velocities along x: speeds beyond 3 from a density c^2 exp(-A c^alpha), and as many of speed 0 as
// make v_0 = 1, that is < v^2 > = 3/2.
std::vector<Vector> with_tail(std::size_t count, double A, double alpha, Random& random) {
  std::vector<Vector> velocity;
  double squares = 0;
  while (velocity.size() < count) {
    // Drawn from an exponential whose rate is that of the tail at its beginning.
    const double rate = 0.5 * A * alpha * std::pow(3, alpha - 1);
    const double c = 3 - std::log(random.uniform()) / rate;
    const double ratio = std::pow(c / 3, 2) *
                         std::exp(-A * (std::pow(c, alpha) - std::pow(3, alpha)) + rate * (c - 3));
    if (random.uniform() * 2 > ratio) continue;  // ratio < 2 for all tails below
    velocity.push_back({c, 0, 0});
    squares += c * c;
  }
  velocity.resize(static_cast<std::size_t>(squares / 1.5));
  return velocity;
}

}  // namespace

TEST_CASE("tail: the exponent of the density from which the speeds were drawn") {
  // The Fisher information of 10 000 speeds gives alpha a standard error of 0.06 to 0.1; 0.4 are
  // allowed.
  Random random(11);
  for (const double alpha : {1.0, 1.5, 2.0}) {
    CAPTURE(alpha);
    const double A = alpha == 1 ? 2.5 : 1;
    const auto found = tail(with_tail(10000, A, alpha, random));
    REQUIRE(found.exponent);
    CHECK(std::abs(*found.exponent - alpha) < 0.4);
  }
}

TEST_CASE("tail: bins of a Gaussian gas") {
  // 440 of 10^6 speeds are beyond 3: bins agree within 4.5 standard errors plus the bin's width.
  Random random(12);
  const auto found = tail(thermal_velocities(1'000'000, random));
  REQUIRE(found.c.size() == tail_bins);
  CHECK(found.c[0] == Approx(3 * std::sqrt(tail_factor)));
  const auto begins_beyond = [](double c) {  // P(c > low)
    return std::erfc(c) + 2 / std::sqrt(std::numbers::pi) * c * std::exp(-c * c);
  };
  CHECK(static_cast<double>(found.particles) == Approx(1e6 * begins_beyond(3)).epsilon(0.2));
  for (std::size_t b = 0; b < 4; ++b) {
    const double low = 3 * std::pow(tail_factor, static_cast<double>(b)), high = low * tail_factor;
    const double expected = begins_beyond(low) - begins_beyond(high);
    const double shell = 4 * std::numbers::pi / 3 * (std::pow(high, 3) - std::pow(low, 3)) /
                         std::pow(std::numbers::pi, 1.5);
    CHECK(std::abs(found.rho[b] * shell - expected) < 4.5 * std::sqrt(expected / 1e6));
  }
  CHECK(found.rho.back() == 0);
}

TEST_CASE("tail: too few speeds have no exponent") {
  Random random(13);
  CHECK_FALSE(tail(thermal_velocities(1000, random)).exponent);
  CHECK_THROWS_AS(tail(std::vector<Vector>(5)), std::invalid_argument);
}
