// SPDX-License-Identifier: GPL-3.0-or-later

// Particles shared out among the nearest points of a mesh, "cloud in cell", and the effect of this
// on a mode: Y. P. Jing, Astrophys. J. 620, 559 (2005), eqs. 17 to 21 with p = 2. For the .cpp
// files of this room only.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "analysis/observables/mesh.hpp"

namespace haff::analysis {

// The two mesh points nearest to x along an axis, and the shares they get.
struct Shares {
  std::array<int, 2> point;
  std::array<double, 2> share;
};

inline Shares shares(double x, const Mesh& mesh) {
  const double place = x * (mesh.cells / mesh.box);
  const int below = mesh.place(x);
  const double above = place - below;
  return {{below, below + 1 == mesh.cells ? 0 : below + 1}, {1 - above, above}};
}

// Replaces the field by the sum of the shares of all particles, where particle i carries weight(i).
template <class Weight>
void share_out(std::span<const Vector> position, const Mesh& mesh, std::span<double> field,
               Weight&& weight) {
  std::fill(field.begin(), field.end(), 0.0);
  for (std::size_t number = 0; number < position.size(); ++number) {
    const Vector& r = position[number];
    const double carried = weight(number);
    const Shares x = shares(r[0], mesh), y = shares(r[1], mesh);
    const Shares z = mesh.d == 3 ? shares(r[2], mesh) : Shares{{0, 0}, {1, 0}};
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j)
        for (std::size_t k = 0; k < (mesh.d == 3 ? 2 : 1); ++k)
          field[mesh.number({x.point[i], y.point[j], z.point[k]})] +=
              x.share[i] * y.share[j] * z.share[k] * carried;
  }
}

// The effect of sharing out along one axis on the power of a mode, and the power of uncorrelated
// particles that is folded into the mode.
struct Distortion {
  double power = 1;   // sinc^4
  double folded = 1;  // 1 - (2/3) sin^2
};

inline Distortion distortion(int wave, int cells) {
  if (wave == 0) return {};
  const double x = std::numbers::pi * wave / cells;
  const double sine = std::sin(x);
  const double sinc = sine / x;
  return {sinc * sinc * sinc * sinc, 1 - 2.0 / 3 * sine * sine};
}

// The distortions of the wave numbers 0 ... cells/2 along an axis.
inline std::vector<Distortion> distortions(int cells) {
  std::vector<Distortion> axis;
  axis.reserve(static_cast<std::size_t>(cells / 2) + 1);
  for (int wave = 0; wave <= cells / 2; ++wave) axis.push_back(distortion(wave, cells));
  return axis;
}

}  // namespace haff::analysis
