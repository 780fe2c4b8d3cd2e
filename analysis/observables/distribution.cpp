// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/distribution.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>

#include "analysis/observables/moments.hpp"
#include "analysis/theory/gas.hpp"

namespace haff::analysis {

SpeedDistribution speed_distribution(std::span<const Vector> velocity, int d) {
  const double v0_squared = 2 * moments(velocity, d).temperature;
  if (!(v0_squared > 0)) throw std::invalid_argument("a speed distribution of a gas at rest");

  std::vector<std::uint64_t> number(speed_bins + 1);  // and one for speeds beyond them
  for (const Vector& v : velocity) {
    const double planar = v[0] * v[0] + v[1] * v[1];
    const double square = d == 2 ? planar : planar + v[2] * v[2];
    const double bin = std::sqrt(square / v0_squared) / speed_bin;
    ++number[static_cast<std::size_t>(std::min(bin, 1.0 * speed_bins))];
  }

  SpeedDistribution result;
  const double ball = unit_sphere_surface(d) / d / std::pow(std::numbers::pi, 0.5 * d);
  const auto particles = static_cast<double>(velocity.size());
  for (int bin = 0; bin < speed_bins; ++bin) {
    const double low = bin * speed_bin, high = (bin + 1) * speed_bin;
    const double shell = ball * (std::pow(high, d) - std::pow(low, d));
    result.c.push_back((bin + 0.5) * speed_bin);
    result.rho.push_back(static_cast<double>(number[static_cast<std::size_t>(bin)]) /
                         (particles * shell));
  }
  return result;
}

}  // namespace haff::analysis
