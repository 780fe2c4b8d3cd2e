// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/start/lattice.hpp"

#include <algorithm>
#include <cmath>

namespace haff::engine {
namespace {

// Sites of a face-centred cubic lattice with `cells` cubic cells along an axis.
Vector lattice_site(std::uint64_t site, std::uint64_t cells, double spacing) {
  static constexpr Vector basis[4] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  const std::uint64_t cell = site / 4;
  const Vector& offset = basis[site % 4];
  const Vector corner{static_cast<double>(cell % cells), static_cast<double>(cell / cells % cells),
                      static_cast<double>(cell / (cells * cells))};
  Vector position;
  for (std::size_t k = 0; k < 3; ++k) position[k] = (corner[k] + offset[k] + 0.25) * spacing;
  return position;
}

std::uint64_t cells_along(std::uint32_t count) {
  std::uint64_t cells = 1;
  while (4 * cells * cells * cells < count) ++cells;
  return cells;
}

bool cubic_lattice_fits(std::uint32_t count, const Box& box) {
  return box.side / static_cast<double>(cells_along(count)) / std::sqrt(2.0) >= 1;
}

// A triangular lattice, stretched to fit a square: a cell has two sites, the second one in its
// middle.
struct Triangular {
  std::uint64_t columns = 0;
  std::uint64_t rows = 0;
  double width = 0;  // of a cell
  double height = 0;
  double distance = 0;  // between nearest neighbours
};

// The lattice with at least `count` sites on which the nearest neighbours are farthest apart.
Triangular triangular(std::uint32_t count, const Box& box) {
  Triangular best;
  for (std::uint64_t columns = 1; (columns - 1) * (columns - 1) < count; ++columns) {
    const std::uint64_t rows = (count + 2 * columns - 1) / (2 * columns);
    const double width = box.side / static_cast<double>(columns);
    const double height = box.side / static_cast<double>(rows);
    const double diagonal = std::sqrt(width * width + height * height);
    const double distance = std::min({width, height, 0.5 * diagonal});
    if (distance > best.distance) best = {columns, rows, width, height, distance};
  }
  return best;
}

std::vector<Vector> triangular_positions(std::uint32_t count, const Triangular& lattice) {
  std::vector<Vector> positions(count);
  for (std::uint64_t k = 0; k < count; ++k) {  // vacant sites are spread evenly
    const std::uint64_t site = k * 2 * lattice.columns * lattice.rows / count;
    const std::uint64_t cell = site / 2;
    const double offset = site % 2 == 0 ? 0.25 : 0.75;
    positions[k] = {(static_cast<double>(cell % lattice.columns) + offset) * lattice.width,
                    (static_cast<double>(cell / lattice.columns) + offset) * lattice.height, 0};
  }
  return positions;
}

std::vector<Vector> cubic_positions(std::uint32_t count, const Box& box) {
  const std::uint64_t cells = cells_along(count);
  const std::uint64_t sites = 4 * cells * cells * cells;
  std::vector<Vector> positions(count);
  for (std::uint64_t k = 0; k < count; ++k)  // vacant sites are spread evenly
    positions[k] = lattice_site(k * sites / count, cells, box.side / static_cast<double>(cells));
  return positions;
}

}  // namespace

std::optional<std::vector<Vector>> lattice_positions(std::uint32_t count, const Box& box) {
  if (box.d == 2) {
    const Triangular lattice = triangular(count, box);
    if (lattice.distance >= 1) return triangular_positions(count, lattice);
  } else if (cubic_lattice_fits(count, box)) {
    return cubic_positions(count, box);
  }
  return std::nullopt;
}

bool lattice_fits(std::uint32_t count, const Box& box) {
  return box.d == 2 ? triangular(count, box).distance >= 1 : cubic_lattice_fits(count, box);
}

}  // namespace haff::engine
