// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/plot/plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "campaign/plot/colours.hpp"

namespace haff::campaign {

double Curve::error_at(std::size_t i) const {
  return i < error.size() ? error[i] : std::numeric_limits<double>::quiet_NaN();
}

std::string ToneScale::tone(double value) const {
  const auto at = [&](double v) { return logarithmic ? std::log(v) : v; };
  const double share = high > low ? (at(value) - at(low)) / (at(high) - at(low)) : 0;
  constexpr std::size_t steps = 1000;
  return shade(static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * (steps - 1)), steps);
}

bool has_arrows(const Panel& panel) {
  return std::ranges::any_of(panel.curves, [](const Curve& c) { return !c.arrow.empty(); });
}

Range y_range(const std::vector<Curve>& curves, bool logarithmic) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Range range{infinity, -infinity};
  const auto include = [&](double y) {
    if (!std::isfinite(y) || (logarithmic && y <= 0)) return;
    range.low = std::min(range.low, y);
    range.high = std::max(range.high, y);
  };
  for (const Curve& curve : curves) {
    for (std::size_t i = 0; i < curve.y.size(); ++i) {
      include(curve.y[i]);
      if (logarithmic) continue;  // bars may reach anywhere
      include(curve.y[i] - curve.error_at(i));
      include(curve.y[i] + curve.error_at(i));
    }
  }
  return range.low <= range.high ? range : Range{0, 1};
}

double decade_below(double value) {
  constexpr double room = 0.3;  // of a decade
  return std::pow(10, std::floor(std::log10(value) - room));
}

double round_step(double at_least) {
  const double power = std::pow(10, std::floor(std::log10(at_least)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= at_least) return step * power;
  }
  return 10 * power;
}

}  // namespace haff::campaign
