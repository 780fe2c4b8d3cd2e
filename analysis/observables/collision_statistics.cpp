// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/collision_statistics.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace haff::analysis {
namespace {

std::int64_t all_of(std::span<const std::int64_t> counts) {
  if (counts.empty()) throw std::invalid_argument("a density without bins");
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

Density density_of(std::span<const std::int64_t> counts, double width, std::size_t shown) {
  const std::int64_t all = all_of(counts);
  Density result;
  if (all == 0) return result;
  for (std::size_t i = 0; i < shown; ++i) {
    result.x.push_back((static_cast<double>(i) + 0.5) * width);
    result.value.push_back(static_cast<double>(counts[i]) / (static_cast<double>(all) * width));
  }
  return result;
}

}  // namespace

Density density(std::span<const std::int64_t> counts, double width) {
  return density_of(counts, width, counts.size());
}

Density density_with_rest(std::span<const std::int64_t> counts, double width) {
  return density_of(counts, width, counts.size() - 1);
}

Density density_of_free_times(std::span<const std::int64_t> counts, int per_unit,
                              std::uint32_t particles) {
  const auto all = static_cast<double>(all_of(counts));
  Density result;
  if (all == 0) return result;
  const std::int64_t N = particles, resolution = 2 * std::int64_t{per_unit};
  // The first k in a bin. The first bin begins with k = 1, since no free time is zero.
  const auto first = [&](std::int64_t bin) {
    return std::max<std::int64_t>(1, (bin * N + resolution - 1) / resolution);
  };
  for (std::size_t i = 0; i + 1 < counts.size(); ++i) {
    const auto bin = static_cast<std::int64_t>(i);
    const std::int64_t from = first(bin), to = first(bin + 1);
    if (from == to) continue;  // in a gas so small that no k falls into this bin
    const double width = 2 * static_cast<double>(to - from) / particles;
    result.x.push_back(static_cast<double>(from + to - 1) / particles);
    result.value.push_back(static_cast<double>(counts[i]) / (all * width));
  }
  return result;
}

}  // namespace haff::analysis
