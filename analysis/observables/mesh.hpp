// SPDX-License-Identifier: GPL-3.0-or-later

// A periodic box divided into equal cubic cells, in which particles are counted.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace haff::analysis {

using Vector = std::array<double, 3>;  // in a planar gas the third component is ignored

struct Mesh {
  double box = 0;  // side L [sigma]
  int cells = 0;   // along each axis
  int d = 3;       // dimension

  double cell_side() const { return box / cells; }
  std::size_t size() const {
    const auto side = static_cast<std::size_t>(cells);
    return side * side * (d == 3 ? side : 1);
  }

  // The cell along one axis that holds x in [0, L).
  int place(double x) const {
    return std::clamp(static_cast<int>(x * (cells / box)), 0, cells - 1);
  }

  // The number of the cell at (i, j, k). The last axis runs fastest.
  std::size_t number(const std::array<int, 3>& cell) const {
    std::size_t number = 0;
    for (int axis = 0; axis < d; ++axis)
      number = number * static_cast<std::size_t>(cells) +
               static_cast<std::size_t>(cell[static_cast<std::size_t>(axis)]);
    return number;
  }

  std::array<int, 3> cell_of(const Vector& position) const {
    return {place(position[0]), place(position[1]), d == 3 ? place(position[2]) : 0};
  }
};

// The largest number of cells along an axis with at least this many of N particles per cell on
// average.
inline int cells_with(double particles_each, double particles, int d) {
  const auto enough = [&](int cells) {
    const double side = cells;
    return side * side * (d == 3 ? side : 1) * particles_each <= particles;
  };
  int cells = 1;
  while (enough(cells + 1)) ++cells;
  return cells;
}

}  // namespace haff::analysis
