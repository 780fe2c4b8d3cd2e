// SPDX-License-Identifier: GPL-3.0-or-later

// A thin grey line across a panel, behind its curves: where a quantity is zero, or a ratio one.
#pragma once

#include <fmt/format.h>

#include <string>

namespace haff::campaign {

// The command of gnuplot that draws it at this y.
inline std::string reference_line(double y) {
  return fmt::format(
      "set arrow from graph 0, first {0:g} to graph 1, first {0:g} nohead back lw 0.7 "
      "lc rgb '#888888'",
      y);
}

}  // namespace haff::campaign
