// SPDX-License-Identifier: GPL-3.0-or-later

// The pair distribution g(r), and its value at contact.
//
//   g(r)    pairs at a distance r, relative to the number of pairs that particles at
//           random positions in the box would have there: N (N-1)/2 in all, N_a N_b between two
//           species
//   sigma   the contact distance, (sigma_a + sigma_b)/2
//   chi     g(sigma+)
//
// A state that is taken after a number of collisions has one pair in contact, the pair that has
// just collided, which it would not have at a moment chosen at random. This pair is not counted: it
// would make chi larger by 40/(n Omega_d N/2), 1.5e-3 at n = 0.1 and N = 32 000.
//
// chi is extrapolated without bins. With x = (r - sigma)/w and the weight
//   W(x) = (1/w) sum_{l <= 3} (2l+1) (-1)^l P_l(2x - 1)    (Christoffel and Darboux),
// int W g dr over one w is g(sigma) for every cubic g: it is the value that least squares with a
// cubic would give. So chi is a sum of W over pairs, biased only by the deviation of g from a
// cubic, and its mean over realizations needs no further fit. chi also enters the equation of
// state: p/(n T) = 1 + 2^(d-1) phi chi (theory/enskog.hpp). J. P. Hansen and I. R. McDonald, Theory
// of Simple Liquids, secs. 2.5, 2.6.
#pragma once

#include <span>
#include <vector>

#include "analysis/observables/mesh.hpp"

namespace haff::analysis {

// The width of the bins of g, and its range, half a box at most. [sigma of the larger species]
inline constexpr double pair_bin = 0.05;
inline constexpr double pair_reach = 4;

// The range w from which chi is extrapolated. The deviation of the g(r) of Percus and Yevick from a
// cubic makes chi too large by 2e-5 at n = 0.2, 1.2e-4 at 0.4, 4e-4 at 0.6 and 9.5e-4 at 0.8
// (relative); narrower ranges hold fewer pairs, and the variance is proportional to 16/w. [sigma]
inline constexpr double contact_range = 0.4;

struct PairDistribution {
  std::vector<double> r;  // the contact distance, then the middle of each bin [sigma]
  std::vector<double> g;  // chi, then the mean over each bin's shell
};

// The pair distribution of particles at positions in [0, L). r depends on box, d, contact and reach
// alone; chi needs a reach of at least contact + contact_range. The standard error of one state is
// g/sqrt(pairs in the bin), and for chi about sqrt(16 chi / (w n Omega_d N/2)). Throws
// std::invalid_argument for fewer than two particles or a box narrower than 4 sigma.
PairDistribution pair_distribution(std::span<const Vector> position, double box, int d = 3,
                                   double contact = 1, double reach = pair_reach);

// The pair distribution between particles of two species. Throws likewise, and also if a species
// has no particle.
PairDistribution pair_distribution(std::span<const Vector> one, std::span<const Vector> other,
                                   double box, double contact, int d = 3);

}  // namespace haff::analysis
