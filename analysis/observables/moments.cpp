// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/moments.hpp"

#include <gsl/gsl_sf_gamma.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace haff::analysis {
namespace {

// Sums run in eight independent lanes, which compilers vectorize without reordering, and in blocks,
// so that rounding errors do not grow with N.
constexpr std::size_t lanes = 8;
constexpr std::size_t block = 512 * lanes;

using PowerSums = std::array<double, highest_laguerre>;  // sum of v^2, v^4, ..., v^12

template <int d>
double square(const std::array<double, 3>& v) {
  const double planar = v[0] * v[0] + v[1] * v[1];
  if constexpr (d == 2) return planar;
  return planar + v[2] * v[2];
}

template <int d>
PowerSums block_sums(std::span<const std::array<double, 3>> velocity) {
  double sums[highest_laguerre][lanes] = {};
  const auto add = [&](std::size_t first, std::size_t count) {
    double v2[lanes];
    double power[lanes];
    for (std::size_t lane = 0; lane < count; ++lane) {
      v2[lane] = square<d>(velocity[first + lane]);
      power[lane] = 1;
    }
    for (auto& sum : sums) {
      for (std::size_t lane = 0; lane < count; ++lane) {
        power[lane] *= v2[lane];
        sum[lane] += power[lane];
      }
    }
  };
  const std::size_t whole = velocity.size() - velocity.size() % lanes;
  for (std::size_t i = 0; i < whole; i += lanes) add(i, lanes);
  add(whole, velocity.size() - whole);

  PowerSums total{};
  for (std::size_t k = 0; k < total.size(); ++k) {
    const auto& s = sums[k];
    total[k] = ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
  }
  return total;
}

template <int d>
PowerSums power_sums(std::span<const std::array<double, 3>> velocity) {
  PowerSums total{};
  for (std::size_t first = 0; first < velocity.size(); first += block) {
    const auto part =
        block_sums<d>(velocity.subspan(first, std::min(block, velocity.size() - first)));
    for (std::size_t k = 0; k < total.size(); ++k) total[k] += part[k];
  }
  return total;
}

}  // namespace

LaguerreCoefficients laguerre_from_moments(const LaguerreCoefficients& c_moments, int d) {
  LaguerreCoefficients normal{};
  double gaussian = 1;  // Gamma(k + d/2) / Gamma(d/2)
  for (int k = 0; k <= highest_laguerre; ++k) {
    normal[static_cast<std::size_t>(k)] = c_moments[static_cast<std::size_t>(k)] / gaussian;
    gaussian *= 0.5 * d + k;
  }
  LaguerreCoefficients a{};
  for (std::size_t l = 0; l < a.size(); ++l) {
    double signed_binomial = 1;
    for (std::size_t k = 0; k <= l; ++k) {
      a[l] += signed_binomial * normal[k];
      signed_binomial *= -static_cast<double>(l - k) / static_cast<double>(k + 1);
    }
  }
  return a;
}

Moments moments(std::span<const std::array<double, 3>> velocity, int d) {
  if (velocity.empty()) throw std::invalid_argument("moments of an empty velocity array");
  if (d != 2 && d != 3) throw std::invalid_argument("moments: dimension must be 2 or 3");
  const PowerSums sums = d == 2 ? power_sums<2>(velocity) : power_sums<3>(velocity);
  const auto count = static_cast<double>(velocity.size());
  const double mean_square = sums[0] / count;
  const double v0_squared = 2 * mean_square / d;

  LaguerreCoefficients c_moments{1, 0.5 * d};
  double unit = v0_squared;
  for (std::size_t k = 2; k < c_moments.size(); ++k) {
    unit *= v0_squared;
    c_moments[k] = sums[k - 1] / count / unit;
  }
  Moments result{.temperature = mean_square / d, .laguerre = laguerre_from_moments(c_moments, d)};
  return result;
}

double laguerre_noise(int l, double particles, int d) {
  const double norm = gsl_sf_gamma(l + 1) * gsl_sf_gamma(0.5 * d) / gsl_sf_gamma(l + 0.5 * d);
  return std::sqrt(norm / particles);
}

}  // namespace haff::analysis
