// SPDX-License-Identifier: GPL-3.0-or-later

// Every pair of particles that is closer than a given distance, by linked cells. For the .cpp files
// of this room only.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "analysis/observables/mesh.hpp"

namespace haff::analysis {

// The particles of a periodic box, sorted into cells. The set of pairs visited depends on neither
// the cells nor the order of the particles; the order of the visits does.
class Pairs {
 public:
  // Positions in [0, L). Throws std::invalid_argument if the reach is more than half of the box,
  // where a particle would have to be paired with two images of another.
  Pairs(std::span<const Vector> position, double box, int d, double reach);

  // Calls visit(i, j, squared distance) once for each pair whose distance is below the reach.
  template <class Visit>
  void for_each(Visit&& visit) const {
    const double reach2 = reach_ * reach_;
    const auto check = [&](std::size_t a, std::size_t b, const Vector& shift) {
      double distance2 = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = position_[a][k] - position_[b][k] - shift[k];
        distance2 += x * x;
      }
      if (distance2 < reach2) visit(number_[a], number_[b], distance2);
    };
    if (!has_cells_) {
      for (std::size_t a = 0; a < position_.size(); ++a)
        for (std::size_t b = a + 1; b < position_.size(); ++b)
          check(a, b, nearest(position_[a], position_[b]));
      return;
    }
    std::array<int, 3> cell{};
    for (cell[0] = 0; cell[0] < mesh_.cells; ++cell[0])
      for (cell[1] = 0; cell[1] < mesh_.cells; ++cell[1])
        for (cell[2] = 0; cell[2] < (mesh_.d == 3 ? mesh_.cells : 1); ++cell[2]) {
          const std::size_t here = mesh_.number(cell);
          if (first_[here] == first_[here + 1]) continue;
          for (std::size_t a = first_[here]; a < first_[here + 1]; ++a)
            for (std::size_t b = a + 1; b < first_[here + 1]; ++b) check(a, b, Vector{});
          for (const auto& offset : offsets_) {
            Vector shift{};
            auto other = cell;
            for (std::size_t k = 0; k < 3; ++k) {
              other[k] += offset[k];
              if (other[k] >= mesh_.cells) {
                other[k] -= mesh_.cells;
                shift[k] = mesh_.box;
              } else if (other[k] < 0) {
                other[k] += mesh_.cells;
                shift[k] = -mesh_.box;
              }
            }
            const std::size_t there = mesh_.number(other);
            for (std::size_t a = first_[here]; a < first_[here + 1]; ++a)
              for (std::size_t b = first_[there]; b < first_[there + 1]; ++b) check(a, b, shift);
          }
        }
  }

 private:
  // The shift of b to its image that is nearest to a.
  Vector nearest(const Vector& a, const Vector& b) const {
    Vector shift{};
    for (std::size_t k = 0; k < 3; ++k)
      shift[k] = mesh_.box * std::nearbyint((a[k] - b[k]) / mesh_.box);
    return shift;
  }

  Mesh mesh_;
  double reach_;
  bool has_cells_ = false;
  std::vector<Vector> position_;  // cell by cell; z = 0 in a planar gas
  std::vector<std::uint32_t> number_;
  std::vector<std::size_t> first_;  // the first particle of each cell, and one beyond the last
  std::vector<std::array<int, 3>> offsets_;  // half of the neighbours: each pair of cells once
};

}  // namespace haff::analysis
