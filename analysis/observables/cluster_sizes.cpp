// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/cluster_sizes.hpp"

#include <bit>
#include <cstdint>
#include <stdexcept>

#include "analysis/observables/pairs.hpp"
#include "analysis/observables/sets.hpp"

namespace haff::analysis {

ClusterSizes cluster_sizes(std::span<const Vector> position, double box, int d,
                           const std::function<double(std::size_t, std::size_t)>& contact) {
  if (position.empty()) throw std::invalid_argument("a cluster needs particles");
  Sets sets(position.size());
  Pairs(position, box, d, bond).for_each([&](std::size_t i, std::size_t j, double distance2) {
    const double length = contact ? bond * contact(i, j) : bond;
    if (distance2 < length * length) sets.join(i, j);
  });
  std::vector<std::uint64_t> members(position.size());
  for (std::size_t i = 0; i < position.size(); ++i) ++members[sets.root(i)];

  const auto classes = static_cast<std::size_t>(std::bit_width(position.size()));
  std::vector<std::uint64_t> held(classes);
  double squares = 0;
  for (const std::uint64_t size : members) {
    if (size == 0) continue;
    held[static_cast<std::size_t>(std::bit_width(size)) - 1] += size;
    squares += static_cast<double>(size) * static_cast<double>(size);
  }
  const auto particles = static_cast<double>(position.size());
  ClusterSizes result;
  double smallest = 1;
  for (const std::uint64_t each : held) {
    result.size.push_back(smallest);
    result.share.push_back(static_cast<double>(each) / particles);
    smallest *= 2;
  }
  result.mean = squares / particles;
  return result;
}

}  // namespace haff::analysis
