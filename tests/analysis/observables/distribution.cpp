// SPDX-License-Identifier: GPL-3.0-or-later

// The velocity distribution: its normalization, exact speeds, and a Gaussian gas.
#include "analysis/observables/distribution.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

#include "analysis/particles.hpp"

using namespace haff::analysis;
using doctest::Approx;
using std::numbers::pi;

namespace {

// int d^dc rho, summed over the bins.
double integral(const SpeedDistribution& speeds, int d) {
  double sum = 0;
  for (std::size_t i = 0; i < speeds.c.size(); ++i) {
    const double low = speeds.c[i] - 0.05, high = speeds.c[i] + 0.05;
    sum += speeds.rho[i] * (d == 3 ? 4 * pi / 3 * (high * high * high - low * low * low)
                                   : pi * (high * high - low * low));
  }
  return sum;
}

}  // namespace

TEST_CASE("distribution: it integrates to pi^(d/2)") {
  Random random(8);
  const auto velocity = thermal_velocities(1000, random);
  for (const int d : {2, 3})
    CHECK(integral(speed_distribution(velocity, d), d) ==
          Approx(std::pow(pi, 0.5 * d)).epsilon(1e-12));
}

TEST_CASE("distribution: equal speeds are in one bin") {
  // All speeds are v: v_0^2 = 2 v^2 / d, c = sqrt(3/2) = 1.2247.
  const std::vector<Vector> velocity = {{2, 0, 0}, {0, -2, 0}, {0, 0, 2}};
  const auto speeds = speed_distribution(velocity);
  for (std::size_t i = 0; i < speeds.c.size(); ++i) CHECK((speeds.rho[i] > 0) == (i == 12));
  CHECK(speeds.c[12] == Approx(1.25));
  const double shell = 4 * pi / 3 * (1.3 * 1.3 * 1.3 - 1.2 * 1.2 * 1.2);
  CHECK(speeds.rho[12] == Approx(std::pow(pi, 1.5) / shell).epsilon(1e-12));
}

TEST_CASE("distribution: a Gaussian gas has exp(-c^2)") {
  // Bins with more than 100 of 10^6 particles, within 4.5 standard errors plus the difference
  // between shell and middle: a false alarm in one of 4000 seeds.
  Random random(9);
  constexpr std::size_t count = 1'000'000;
  const auto speeds = speed_distribution(thermal_velocities(count, random));
  for (std::size_t i = 0; i < speeds.c.size(); ++i) {
    const double c = speeds.c[i], gaussian = std::exp(-c * c);
    const double particles = count * gaussian * 4 * pi * c * c * 0.1 / std::pow(pi, 1.5);
    if (particles < 100) continue;
    const double shell = (0.01 / 24) * (4 * c * c + 10);  // second derivative and weight [relative]
    CHECK(std::abs(speeds.rho[i] / gaussian - 1) < 4.5 / std::sqrt(particles) + shell);
  }
}

TEST_CASE("distribution: scaled velocities have the same distribution") {
  Random random(10);
  auto velocity = thermal_velocities(1000, random);
  const auto before = speed_distribution(velocity).rho;
  for (Vector& v : velocity)
    for (double& component : v) component *= 0x1p-40;
  CHECK(speed_distribution(velocity).rho == before);
}

TEST_CASE("distribution: a gas at rest is refused") {
  const std::vector<Vector> none, rest(3);
  CHECK_THROWS_AS(speed_distribution(none), std::invalid_argument);
  CHECK_THROWS_AS(speed_distribution(rest), std::invalid_argument);
}
