// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/statistics/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace haff::analysis {
namespace {

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Means of neighbouring pairs; an odd last value is left out.
std::vector<double> halved(std::span<const double> values) {
  std::vector<double> pairs(values.size() / 2);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    pairs[i] = 0.5 * (values[2 * i] + values[2 * i + 1]);
  return pairs;
}

// The variance of the mean of `count` neighbours relative to that of one value, in a series whose
// correlations fall as rho^lag.
double variance_of_mean(double rho, double count) {
  const double rest = 1 - rho;
  return ((1 + rho) / rest - 2 * rho * (1 - std::pow(rho, count)) / (count * rest * rest)) / count;
}

// The rho with which means of `length` neighbours have `ratio` times the variance of single values,
// both about the mean of the same `count` values.
double correlation_of(double ratio, double length, double count) {
  const auto expected = [&](double rho) {
    const double known = variance_of_mean(rho, count);
    return (variance_of_mean(rho, length) - known) / (1 - known);
  };
  // Correlations extend over an eighth of the series at most: a series does not determine longer
  // ones.
  double low = 0, high = std::max(0.0, 1 - 8 / count);
  if (expected(low) >= ratio) return low;
  if (expected(high) <= ratio) return high;
  while (high - low > 1e-12) {
    const double middle = 0.5 * (low + high);
    (expected(middle) < ratio ? low : high) = middle;
  }
  return low;
}

}  // namespace

Estimate estimate(std::span<const double> values) {
  if (values.empty()) throw std::invalid_argument("estimate of no values");
  const double mean = mean_of(values);
  const auto count = static_cast<double>(values.size());
  double squares = 0;
  for (const double x : values) squares += (x - mean) * (x - mean);
  const double error = values.size() == 1 ? std::numeric_limits<double>::quiet_NaN()
                                          : std::sqrt(squares / (count * (count - 1)));
  return {.mean = mean, .standard_error = error, .count = values.size()};
}

BlockEstimate block_estimate(std::span<const double> series) {
  if (series.size() < 2) throw std::invalid_argument("block average of fewer than two values");
  constexpr std::size_t fewest_blocks = 8;  // with fewer, the error of the error exceeds a quarter
  const Estimate naive = estimate(series);
  BlockEstimate best{.estimate = naive};
  const auto long_enough = [&] {
    const double inflation = best.estimate.standard_error / naive.standard_error;
    const double size = static_cast<double>(series.size());
    return std::pow(static_cast<double>(best.block_length), 3) > 2 * size * std::pow(inflation, 4);
  };

  std::vector<double> blocks(series.begin(), series.end());
  while (naive.standard_error > 0 && blocks.size() >= 2 * fewest_blocks && !long_enough()) {
    blocks = halved(blocks);
    best.estimate = estimate(blocks);
    best.block_length *= 2;
  }
  best.estimate.mean = naive.mean;
  if (naive.standard_error > 0) {
    const double size = static_cast<double>(series.size());
    const auto length = static_cast<double>(best.block_length);
    const auto scatter = [](const Estimate& of) {  // the variance of one value
      return of.standard_error * of.standard_error * static_cast<double>(of.count);
    };
    const double rho = correlation_of(scatter(best.estimate) / scatter(naive), length, size);
    const double known = variance_of_mean(rho, size);
    if (rho > 0) best.estimate.standard_error = std::sqrt(scatter(naive) / (1 - known) * known);
    best.correlation_time = 0.5 * std::pow(best.estimate.standard_error / naive.standard_error, 2);
  }
  return best;
}

std::vector<double> smoothed(std::span<const double> series, std::size_t window) {
  if (window % 2 == 0) throw std::invalid_argument("moving average: the window must be odd");
  std::vector<double> result(series.size());
  for (std::size_t i = 0; i < series.size(); ++i) {
    const std::size_t reach = std::min({window / 2, i, series.size() - 1 - i});
    result[i] = mean_of(series.subspan(i - reach, 2 * reach + 1));
  }
  return result;
}

}  // namespace haff::analysis
