// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/structure.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>

#include "analysis/observables/fourier.hpp"
#include "analysis/observables/sets.hpp"
#include "analysis/observables/sharing.hpp"

namespace haff::analysis {

StructureFactor structure_factor(std::span<const Vector> position, double box, int d) {
  if (position.empty() || !(box >= smallest_spectral_box))
    throw std::invalid_argument("a structure factor needs particles in a box of 8 sigma");
  const Mesh mesh{.box = box, .cells = transform_cells(box), .d = d};
  Fourier fourier(mesh);
  share_out(position, mesh, fourier.field(), [](std::size_t) { return 1.0; });
  fourier.forward();

  const auto axis = distortions(mesh.cells);
  const auto at = [&](int wave) { return axis[static_cast<std::size_t>(std::abs(wave))]; };

  const auto shells = static_cast<std::size_t>(mesh.cells / 4);
  std::vector<double> sum(shells), k_sum(shells), count(shells);
  const auto modes = fourier.modes();
  fourier.for_each_mode([&](std::size_t number, const std::array<int, 3>& k, int weight) {
    const double length = std::sqrt(k[0] * k[0] + k[1] * k[1] + k[2] * k[2]);
    const auto shell = static_cast<std::size_t>(std::lround(length));
    if (shell < 1 || shell > shells) return;
    const double power = at(k[0]).power * at(k[1]).power * at(k[2]).power;
    const double folded = at(k[0]).folded * at(k[1]).folded * at(k[2]).folded;
    const double raw = std::norm(modes[number]) / static_cast<double>(position.size());
    sum[shell - 1] += weight * (1 + (raw - folded) / power);
    k_sum[shell - 1] += weight * length;
    count[shell - 1] += weight;
  });

  StructureFactor result;
  for (std::size_t s = 0; s < shells; ++s) {
    result.k.push_back(2 * std::numbers::pi / box * k_sum[s] / count[s]);
    result.value.push_back(sum[s] / count[s]);
  }
  return result;
}

double largest_cluster(std::span<const Vector> position, double box, int d) {
  if (position.empty()) throw std::invalid_argument("a cluster needs particles");
  const auto particles = static_cast<double>(position.size());
  const Mesh mesh{.box = box, .cells = cells_with(particles_in_cluster_cell, particles, d), .d = d};
  std::vector<std::uint32_t> number(mesh.size());
  for (const Vector& r : position) ++number[mesh.number(mesh.cell_of(r))];

  const double mean = particles / static_cast<double>(mesh.size());
  const auto is_dense = [&](std::size_t cell) { return number[cell] > cluster_density * mean; };
  Sets sets(mesh.size());
  std::array<int, 3> cell{};
  for (cell[0] = 0; cell[0] < mesh.cells; ++cell[0])
    for (cell[1] = 0; cell[1] < mesh.cells; ++cell[1])
      for (cell[2] = 0; cell[2] < (d == 3 ? mesh.cells : 1); ++cell[2]) {
        const std::size_t here = mesh.number(cell);
        if (!is_dense(here)) continue;
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(d); ++axis) {
          auto next = cell;
          next[axis] = next[axis] + 1 == mesh.cells ? 0 : next[axis] + 1;
          if (is_dense(mesh.number(next))) sets.join(here, mesh.number(next));
        }
      }

  std::vector<std::uint64_t> held(mesh.size());
  std::uint64_t most = 0;
  for (std::size_t c = 0; c < mesh.size(); ++c)
    if (is_dense(c)) most = std::max(most, held[sets.root(c)] += number[c]);
  return static_cast<double>(most) / particles;
}

}  // namespace haff::analysis
