// SPDX-License-Identifier: GPL-3.0-or-later

// The velocity distribution rho(c), c = v / v_0 with v_0^2 = 2 T / m of that instant, normalized so
// that int d^dc rho = pi^(d/2): a Gaussian gas has exp(-c^2), and the density of speeds is
// Omega_d c^(d-1) rho / pi^(d/2). R. Kawahara and H. Nakanishi, cond-mat/0309130.
#pragma once

#include <span>
#include <vector>

#include "analysis/observables/mesh.hpp"

namespace haff::analysis {

// Bins of the speed c, the same for every gas.
inline constexpr double speed_bin = 0.1;
inline constexpr int speed_bins = 80;

struct SpeedDistribution {
  std::vector<double> c;    // middle of each bin
  std::vector<double> rho;  // mean of rho over the shell of velocities in the bin
};

// The distribution of the first d components of all velocities; those beyond c = 8 are in no bin. A
// bin's relative standard error is 1/sqrt(particles in it); rho of a shell differs from rho at its
// middle by less than 0.7 % below c = 2 and by 3 % at c = 4. Throws std::invalid_argument if there
// are no velocities, or if all are zero.
SpeedDistribution speed_distribution(std::span<const Vector> velocity, int d = 3);

}  // namespace haff::analysis
