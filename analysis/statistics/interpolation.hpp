// SPDX-License-Identifier: GPL-3.0-or-later

// Straight lines between the points of a curve.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>

namespace haff::analysis {

// y at `at`, on the straight line between the neighbouring points; x increases. Nothing outside
// [x.front(), x.back()]. Throws std::invalid_argument if the lengths differ.
inline std::optional<double> interpolated(std::span<const double> x, std::span<const double> y,
                                          double at) {
  if (x.size() != y.size())
    throw std::invalid_argument("interpolation: as many values as places are needed");
  if (x.empty() || !(at >= x.front()) || !(at <= x.back())) return std::nullopt;
  const auto above = std::ranges::lower_bound(x, at);
  const auto i = static_cast<std::size_t>(above - x.begin());
  if (x[i] == at) return y[i];
  const double share = (at - x[i - 1]) / (x[i] - x[i - 1]);
  return y[i - 1] + share * (y[i] - y[i - 1]);
}

}  // namespace haff::analysis
