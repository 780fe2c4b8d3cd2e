// Grows spheres into place where no lattice fits.
//
// B. D. Lubachevsky and F. H. Stillinger, J. Stat. Phys. 60, 561 (1990): spheres that
// start as random points move and collide elastically while their diameter grows at a constant
// rate, until it is sigma.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/particles/box.hpp"
#include "engine/particles/particle.hpp"

namespace haff::engine {

// Positions of `count` spheres (disks if the box is a square) of diameter 1 in the box. Throws
// std::invalid_argument if they jam before.
std::vector<Vector> grown_positions(std::uint32_t count, const Box& box, std::uint64_t seed);

}  // namespace haff::engine
