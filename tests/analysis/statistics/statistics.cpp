// SPDX-License-Identifier: GPL-3.0-or-later

// Means and errors of values whose errors are known.
#include "analysis/statistics/statistics.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <vector>

#include "support/random.hpp"
#include "support/relative.hpp"

using haff::tests::off;
using namespace haff::analysis;
using doctest::Approx;

namespace {

// Uniform numbers of unit variance and zero mean: splitmix64.
struct Noise {
  std::uint64_t state;
  double operator()() {
    return (static_cast<double>(haff::tests::random_bits(state) >> 11) * 0x1p-53 - 0.5) *
           std::sqrt(12.0);
  }
};

// x_k = rho x_{k-1} + sqrt(1 - rho^2) noise: correlation time (1 + rho) / (2 (1 - rho)).
std::vector<double> autoregressive(double rho, std::size_t length, std::uint64_t seed) {
  Noise noise{seed};
  std::vector<double> x(length);
  double last = noise();
  for (auto& each : x) each = last = rho * last + std::sqrt(1 - rho * rho) * noise();
  return x;
}

}  // namespace

TEST_CASE("statistics: mean and standard error by hand") {
  const auto of_three = estimate(std::vector{1.0, 2.0, 6.0});
  CHECK(of_three.mean == 3);
  CHECK(of_three.standard_error == Approx(std::sqrt(14.0 / 6)));  // 4 + 1 + 9 over 3 * 2
  CHECK(of_three.count == 3);
}

TEST_CASE("statistics: one value has no error, and no values are refused") {
  CHECK(std::isnan(estimate(std::vector{5.0}).standard_error));
  CHECK_THROWS_AS(estimate({}), std::invalid_argument);
}

TEST_CASE("statistics: the deviations of numbers far from zero keep their digits") {
  const auto late = estimate(std::vector{1e8 + 1, 1e8 + 2, 1e8 + 3});
  CHECK(late.standard_error == Approx(std::sqrt(2.0 / 6)));
}

TEST_CASE("statistics: blocks find the correlation time of a series") {
  // 64 series of 4096 values: the mean of the estimates is known to 3 %; the method's bias is 5 %.
  for (const double rho : {0.0, 0.8, 0.95}) {
    const double expected = (1 + rho) / (2 * (1 - rho));
    double mean = 0;
    for (std::uint64_t seed = 1; seed <= 64; ++seed) {
      mean += block_estimate(autoregressive(rho, 4096, seed)).correlation_time / 64;
    }
    CHECK(off(mean, expected) < 0.15);
  }
}

TEST_CASE("statistics: intervals of correlated series hold their mean as often as stated") {
  // Two standard errors hold 95.4 % of Gaussian means. The share among 400 series is known to 1 %
  // (2.5 standard errors: 2.6 %); the finite number of blocks costs another percent.
  int covered = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const Estimate mean = block_estimate(autoregressive(0.8, 2048, seed)).estimate;
    if (std::abs(mean.mean) < 2 * mean.standard_error) ++covered;
  }
  CHECK(covered / 400.0 > 0.918);
  CHECK(covered / 400.0 < 0.98);
}

TEST_CASE("statistics: the error of a short, correlated series is not too small by a factor") {
  // 61 samples with a correlation time of 5.8, like the temperature of a heated gas. Without the
  // correction for correlated blocks the root mean square of the error was 0.52 of the true one.
  // 400 series determine it to 5 %; the series whose correlations extend over more than an eighth
  // of their length leave a tenth.
  constexpr double rho = 0.84;
  constexpr int series = 400;
  double mean_square = 0, error_square = 0;
  for (std::uint64_t seed = 1; seed <= series; ++seed) {
    const Estimate mean = block_estimate(autoregressive(rho, 61, seed)).estimate;
    mean_square += mean.mean * mean.mean / series;
    error_square += mean.standard_error * mean.standard_error / series;
  }
  CHECK(std::sqrt(error_square / mean_square) > 0.8);
  CHECK(std::sqrt(error_square / mean_square) < 1.2);
}

// With fewer blocks, the error of the error would exceed a quarter.
TEST_CASE("statistics: at least eight blocks, however long a series is correlated") {
  for (const double rho : {0.99, 0.999})
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      const BlockEstimate blocks = block_estimate(autoregressive(rho, 256, seed));
      CHECK(blocks.block_length == 32);
      CHECK(blocks.estimate.count == 8);
    }
}

TEST_CASE("statistics: a constant series has no error, and a short one is refused") {
  CHECK(block_estimate(std::vector<double>(100, 3.0)).estimate.standard_error == 0);
  CHECK_THROWS_AS(block_estimate(std::vector{1.0}), std::invalid_argument);
}

TEST_CASE("statistics: a moving average keeps straight lines and shrinks at the ends") {
  const std::vector<double> line = {0, 1, 2, 3, 4, 5};
  CHECK(smoothed(line, 5) == line);
  CHECK(smoothed(std::vector{0.0, 3.0, 0.0}, 3) == std::vector{0.0, 1.0, 0.0});
  CHECK_THROWS_AS(smoothed(line, 4), std::invalid_argument);
}
