// SPDX-License-Identifier: GPL-3.0-or-later

// The arrangement of the particles in space: structure factor, and the largest dense region.
//
//   S(k) = |sum_i exp(-i k r_i)|^2 / N
//
// By FFT of the particles shared out among the eight (in the plane four) nearest points of a mesh.
// The effect of this on a mode, and the power of uncorrelated particles that the mesh folds into
// it, are corrected on average: Y. P. Jing, Astrophys. J. 620, 559 (2005), eqs. 17 to 21 with
// p = 2. Only the shells up to half of the mesh's largest wave number are kept. At that end folding
// adds up to 2/9 to the scatter that a mode of one state has anyway, and nothing that survives
// averaging; where S(k) is far below 1, it is wrong by about 0.01 there, and by 10^-4 at an eighth
// of that wave number.
#pragma once

#include <span>
#include <vector>

#include "analysis/observables/mesh.hpp"

namespace haff::analysis {

struct StructureFactor {
  std::vector<double> k;      // mean of a shell of modes, one shell every 2 pi / L [1/sigma]
  std::vector<double> value;  // mean over the shell; 1 for uncorrelated particles
};

// The structure factor of particles at positions in [0, L). k depends on box and d alone. The
// standard error of one state is about S / sqrt(modes in the shell / 2). Throws
// std::invalid_argument for a box smaller than 8 sigma or no particles.
StructureFactor structure_factor(std::span<const Vector> position, double box, int d = 3);

// The fraction of the particles, 0 ... 1, in the largest cluster: cells that share a face, each
// with more than cluster_density times the mean density. Cells hold 20 particles on average. They
// are wide enough that in a homogeneous fluid of n = 0.4 hardly any cell is so dense (the number in
// a cell varies by 10 %), and the result is some 20/N. A Poisson distribution has 1 % of such
// cells, far too few to join. Beyond n = 0.9 no cell can be so dense, and the result has no
// meaning.
inline constexpr double cluster_density = 1.5;
inline constexpr double particles_in_cluster_cell = 20;
double largest_cluster(std::span<const Vector> position, double box, int d = 3);

}  // namespace haff::analysis
