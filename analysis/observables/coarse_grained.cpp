// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/coarse_grained.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace haff::analysis {

int coarse_cells(double particles, int d) {
  constexpr double fewest = 4;  // particles in a cell
  int cells = 32;
  while (cells > 1 && std::pow(cells, d) * fewest > particles) cells /= 2;
  return cells;
}

CoarseGrained coarse_grained(std::span<const Vector> position, std::span<const Vector> velocity,
                             double box, int cells, int d, std::span<const double> mass) {
  if (position.size() != velocity.size() || (!mass.empty() && mass.size() != position.size()))
    throw std::invalid_argument(
        "coarse-grained fields need as many positions as velocities and masses");
  const auto mass_of = [&](std::size_t i) { return mass.empty() ? 1 : mass[i]; };
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Mesh mesh{.box = box, .cells = cells, .d = d};
  const auto axes = static_cast<std::size_t>(d);
  CoarseGrained field{.mesh = mesh,
                      .density = std::vector<double>(mesh.size()),
                      .velocity = std::vector<double>(axes * mesh.size()),
                      .temperature = std::vector<double>(mesh.size())};

  std::vector<std::uint32_t> cell;
  cell.reserve(position.size());
  for (const Vector& r : position)
    cell.push_back(static_cast<std::uint32_t>(mesh.number(mesh.cell_of(r))));

  std::vector<double> mass_in(mesh.size());
  for (std::size_t i = 0; i < cell.size(); ++i) {
    ++field.density[cell[i]];
    mass_in[cell[i]] += mass_of(i);
    for (std::size_t a = 0; a < axes; ++a)
      field.velocity[axes * cell[i] + a] += mass_of(i) * velocity[i][a];
  }
  for (std::size_t c = 0; c < mesh.size(); ++c)
    for (std::size_t a = 0; a < axes; ++a) {
      double& u = field.velocity[axes * c + a];
      u = field.density[c] > 0 ? u / mass_in[c] : none;
    }
  // Deviations are from u itself: <v^2> - u^2 would lose digits where the flow is fast.
  for (std::size_t i = 0; i < cell.size(); ++i)
    for (std::size_t a = 0; a < axes; ++a) {
      const double deviation = velocity[i][a] - field.velocity[axes * cell[i] + a];
      field.temperature[cell[i]] += mass_of(i) * deviation * deviation;
    }
  const double volume = std::pow(mesh.cell_side(), d);
  for (std::size_t c = 0; c < mesh.size(); ++c) {
    const double number = field.density[c];
    field.temperature[c] = number > 1 ? field.temperature[c] / (d * (number - 1)) : none;
    field.density[c] = number / volume;
  }
  return field;
}

}  // namespace haff::analysis
