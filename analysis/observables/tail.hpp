// SPDX-License-Identifier: GPL-3.0-or-later

// The tail of the velocity distribution rho(c), c = v/v_0, beyond c = 3, where bins of equal width
// hold too few particles.
//
// A cooling gas is expected to have rho ~ exp(-A c), and a gas heated by white noise exp(-A
// c^(3/2)): T. P. C. van Noije and M. H. Ernst, Gran. Matter 1, 57 (1998); a Gaussian gas has
// exp(-c^2). The exponent alpha of exp(-A c^alpha) is the one of greatest likelihood, given only
// the speeds beyond c = 3, for a density proportional to c^(d-1) exp(-A c^alpha) there.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/observables/mesh.hpp"

namespace haff::analysis {

// The tail begins at this c; each bin ends at this factor times its beginning.
inline constexpr double tail_begin = 3;
inline constexpr double tail_factor = 1.05;
inline constexpr int tail_bins = 40;  // up to c = 21

// Fewer speeds do not determine an exponent. Its standard error is about 5.5/sqrt(speeds in the
// tail) for a Gaussian gas.
inline constexpr std::size_t fewest_in_tail = 30;

struct Tail {
  std::vector<double> c;                // geometric middle of each bin
  std::vector<double> rho;              // as in distribution.hpp; 0 in a bin without particles
  std::optional<double> exponent = {};  // alpha, between 0.05 and 8; none for too few speeds
  std::size_t particles = 0;            // in the tail
};

// The tail of the first d components of all velocities. Throws std::invalid_argument if there are
// no velocities, or if all are zero.
Tail tail(std::span<const Vector> velocity, int d = 3);

}  // namespace haff::analysis
