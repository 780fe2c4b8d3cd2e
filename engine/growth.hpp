// Growing spheres into place where no lattice fits.
//
// B. D. Lubachevsky and F. H. Stillinger, J. Stat. Phys. 60, 561 (1990): points thrown at random
// move and collide elastically while their diameter grows at a constant rate, until it is sigma.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/particle.hpp"

namespace haff::engine {

// Positions of `count` spheres (of disks if the box is a square) of diameter 1 in the box. Throws
// Breakdown if they jam before.
std::vector<Vector> grown_positions(std::uint32_t count, const Box& box, std::uint64_t seed);

}  // namespace haff::engine
