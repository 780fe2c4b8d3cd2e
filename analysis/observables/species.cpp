// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/species.hpp"

#include <cstddef>
#include <stdexcept>

namespace haff::analysis {

std::array<double, 2> species_temperatures(std::span<const std::array<double, 3>> velocities,
                                           const std::vector<bool>& is_second,
                                           std::array<double, 2> mass, int d) {
  if (velocities.size() != is_second.size())
    throw std::invalid_argument("species_temperatures: as many species as velocities are needed");
  std::array<double, 2> sum{};
  std::array<double, 2> count{};
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    const std::size_t species = is_second[i] ? 1 : 0;
    for (const double v : velocities[i]) sum[species] += mass[species] * v * v;
    ++count[species];
  }
  return {sum[0] / (d * count[0]), sum[1] / (d * count[1])};
}

}  // namespace haff::analysis
