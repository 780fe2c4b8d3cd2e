// SPDX-License-Identifier: GPL-3.0-or-later

// The gas seen as a fluid: density, flow velocity and temperature in cells.
//
//   n(r) = N_r / cell volume,   u(r) = < v >,   T_L(r) = (m/d) < (v - u)^2 > N_r / (N_r - 1)
//
// over the N_r particles of a cell; the last factor corrects for u being their own mean. <u^2>
// still holds a self part of about d T / (m N_r). For particles of several masses u is the velocity
// of their center of mass, and T_L = < m (v - u)^2 > / d, with the same factor. R. Kawahara and H.
// Nakanishi, cond-mat/0309130 (they use 32^3 cells at N = 10^6).
#pragma once

#include <span>
#include <vector>

#include "analysis/observables/mesh.hpp"

namespace haff::analysis {

// Cells of one gas, the last axis fastest.
struct CoarseGrained {
  Mesh mesh;
  std::vector<double> density;  // n(r) [sigma^-d]
  std::vector<double>
      velocity;  // u(r), d components a cell, in the unit of v; NaN in an empty cell
  std::vector<double>
      temperature;  // T_L(r), in the unit of m v^2; NaN for fewer than two particles
};

// 32 cells along each axis, as in the paper; halved until a cell has at least 4 particles on
// average.
int coarse_cells(double particles, int d = 3);

// The fields of particles at positions in [0, L). An empty `mass` means that all masses are 1.
// Error: rounding. Throws std::invalid_argument unless there are as many positions as velocities
// and masses.
CoarseGrained coarse_grained(std::span<const Vector> position, std::span<const Vector> velocity,
                             double box, int cells, int d = 3, std::span<const double> mass = {});

}  // namespace haff::analysis
