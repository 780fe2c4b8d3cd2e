// SPDX-License-Identifier: GPL-3.0-or-later

// Clusters of particles, by their distances alone: two particles belong to one cluster if they are
// closer than a bond, or if both belong to a cluster with a third one.
//
// F. H. Stillinger, J. Chem. Phys. 38, 1486 (1963); for cooling granular gases S. Luding and H. J.
// Herrmann, Chaos 9, 673 (1999), cond-mat/9910089. The result depends on the length of the bond:
// with 1.1 a particle of an elastic gas is in a cluster of 1.09 particles on average at n = 0.05,
// and of 3.7 at n = 0.4 (N = 4000). largest_cluster (structure.hpp) is a criterion of density
// instead.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "analysis/observables/mesh.hpp"

namespace haff::analysis {

// The length of a bond. [contact distance]
inline constexpr double bond = 1.1;

struct ClusterSizes {
  std::vector<double> size;   // the smallest size in each class: 1, 2, 4, 8 ... up to N
  std::vector<double> share;  // of the particles, in clusters of 1, 2 to 3, 4 to 7 ... particles
  double mean = 0;            // size of the cluster that a particle is in, over all particles
};

// The clusters of particles at positions in [0, L). `contact` is the distance at which i and j
// touch; without it the distance is 1 for all. The sizes depend on N alone. Throws
// std::invalid_argument if there are no particles, or if the box is narrower than two bonds.
ClusterSizes cluster_sizes(std::span<const Vector> position, double box, int d = 3,
                           const std::function<double(std::size_t, std::size_t)>& contact = {});

}  // namespace haff::analysis
