// SPDX-License-Identifier: GPL-3.0-or-later

// The gas that a theory describes: restitution, density, dimension. Units: m = sigma = 1.
#pragma once

#include <cmath>
#include <numbers>

namespace haff::analysis {

struct Gas {
  double e = 1;    // normal restitution coefficient, 0 <= e <= 1
  double n = 0.4;  // number density N sigma^d / V [sigma^-d]
  int d = 3;       // dimension, 2 or 3
};

// Surface of the unit sphere, Omega_d: 2 pi in the plane, 4 pi in space.
inline double unit_sphere_surface(int d) {
  return d == 2 ? 2 * std::numbers::pi : 4 * std::numbers::pi;
}

}  // namespace haff::analysis
