// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/answer/frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "campaign/curves/answer/styles.hpp"
#include "campaign/curves/question.hpp"
#include "campaign/plot/text_picture.hpp"

namespace haff::campaign {
namespace {

void set_y_range(const std::vector<Curve>& shown, std::size_t gases, Axis& axis) {
  const std::vector<Curve> measured(shown.begin(),
                                    shown.begin() + static_cast<std::ptrdiff_t>(gases));
  const Range own = y_range(measured, axis.logarithmic);
  Range range = own;
  // A line of theory may leave the picture, but far enough from the points that this is seen.
  const Range all = y_range(shown, axis.logarithmic);
  if (axis.logarithmic) {
    const double room = std::max(1.05, std::pow(own.high / own.low, 0.05));
    axis.low = std::max(all.low, own.low / std::pow(own.high / own.low, 0.3)) / room;
    axis.high = std::min(all.high, own.high * std::pow(own.high / own.low, 0.3)) * room;
    return;
  }
  range.low = std::max(all.low, own.low - 0.5 * own.width());
  range.high = std::min(all.high, own.high + 0.5 * own.width());
  const double room =
      range.width() > 0 ? 0.05 * range.width() : std::max(1e-12, std::abs(own.high));
  axis.low = range.low - room;
  axis.high = range.high + room;
}

void set_x_range(const Panel& panel, Axis& axis) {
  // Nothing is to be seen beyond the last value that is not 0: bins without particles, for
  // instance.
  double low = INFINITY, high = -INFINITY;
  for (const Curve& curve : panel.curves) {
    if (curve.source != Source::measured) continue;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (axis.logarithmic && !(curve.x[i] > 0)) continue;
      if (panel.y.logarithmic && !(curve.y[i] > 0)) continue;
      low = std::min(low, curve.x[i]);
      if (curve.y[i] != 0 || high == -INFINITY) high = std::max(high, curve.x[i]);
    }
  }
  if (!(low < high)) return;
  const bool starts_at_zero = low >= 0 && low < 0.2 * high && !axis.logarithmic;
  if (axis.logarithmic) {
    const double room = std::pow(high / low, 0.03);
    axis.low = low / room;
    axis.high = high * room;
    return;
  }
  const double room = 0.03 * (high - low);
  axis.low = starts_at_zero ? 0 : low - room;
  // A line may end at the frame, which would cut a symbol in half.
  const bool may_touch =
      panel.curves.front().look == Look::line && panel.curves.front().x.size() > most_in_legend;
  axis.high = high + (starts_at_zero && may_touch ? 0 : room);
}

}  // namespace

void check_logarithmic(const Panel& panel) {
  const auto check = [&](const Axis& axis, const char* letter, std::vector<double> Curve::*values) {
    if (!axis.logarithmic) return;
    for (const Curve& curve : panel.curves)
      if (std::ranges::any_of(curve.*values, [](double value) { return value > 0; })) return;
    throw NothingToDraw(fmt::format("nothing to draw with --log {0}: no {0} is above 0", letter));
  };
  check(panel.x, "x", &Curve::x);
  check(panel.y, "y", &Curve::y);
}

void set_ranges(Panel& panel, std::size_t gases) {
  set_x_range(panel, panel.x);
  set_y_range(panel.curves, gases, panel.y);
}

int place_legend(Panel& panel) {
  constexpr int axes_width = 640, scale_width = 90, sample_width = 60;  // pixels
  std::size_t longest = 0, entries = 0;
  for (const Curve& curve : panel.curves) {
    if (curve.legend.empty()) continue;
    ++entries;
    longest = std::max(longest, without_markup(curve.legend).size());
  }
  const double letter = entries > 8 ? 6.3 : 8.4;  // wide in the type that the legend will have
  int beside = panel.scale ? scale_width : 0;
  panel.legend = entries == 0 ? "none" : "beside";
  if (entries > 0) beside += sample_width + static_cast<int>(letter * static_cast<double>(longest));
  panel.axes_share = static_cast<double>(axes_width) / (axes_width + beside);
  return axes_width + beside;
}

}  // namespace haff::campaign
