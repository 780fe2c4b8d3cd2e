// SPDX-License-Identifier: GPL-3.0-or-later

// How the particles lie in space: structure factor, and the largest dense region.
//
//   S(k) = |sum_i exp(-i k r_i)|^2 / N
//
// By FFT of the particles shared out among the eight (in the plane four) nearest points of a mesh;
// what that does to a mode, and what the mesh folds into it from uncorrelated particles, is taken
// out on average: Y. P. Jing, Astrophys. J. 620, 559 (2005), eqs. 17 to 21 with p = 2. Only the
// shells up to half of the mesh's largest wave number are kept. There folding adds scatter of up to
// 2/9 of that which a mode of one state has anyway, and none that survives averaging; a mode of
// S(k) far below 1 is wrong by about 0.01 there, by 10^-4 at an eighth of it.
#pragma once

#include <span>
#include <vector>

#include "analysis/observables/mesh.hpp"

namespace haff::analysis {

struct StructureFactor {
  std::vector<double> k;      // mean of a shell of modes, one shell every 2 pi / L [1/sigma]
  std::vector<double> value;  // mean over the shell; 1 for uncorrelated particles
};

// Of particles at positions in [0, L). k depends on box and d alone. The standard error of one
// state is about S / sqrt(modes in the shell / 2). Throws std::invalid_argument for a box of less
// than 8 sigma or no particles.
StructureFactor structure_factor(std::span<const Vector> position, double box, int d = 3);

// The part of the particles, 0 ... 1, in the largest cluster: cells that share a face and hold each
// more than cluster_density times the mean. Cells hold 20 particles on average, wide enough that
// in a homogeneous fluid of n = 0.4 hardly one is as dense (the number in a cell varies by 10 %),
// and the result is some 20/N. A Poisson distribution has 1 % of such cells, still far from
// joining. Beyond n = 0.9 no cell can be so dense: the measure says nothing there.
inline constexpr double cluster_density = 1.5;
inline constexpr double particles_in_cluster_cell = 20;
double largest_cluster(std::span<const Vector> position, double box, int d = 3);

}  // namespace haff::analysis
