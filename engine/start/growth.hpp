// SPDX-License-Identifier: GPL-3.0-or-later

// Grows spheres into place where no lattice fits.
//
// B. D. Lubachevsky and F. H. Stillinger, J. Stat. Phys. 60, 561 (1990): spheres that start as
// random points move and collide elastically while their diameters grow at a constant rate, all in
// proportion to their final values, until they reach them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/mixture.hpp"
#include "engine/particles/box.hpp"
#include "engine/particles/particle.hpp"

namespace haff::engine {

// Positions of `count` spheres (disks if the box is a square) in the box, by id. Their diameters
// are 1, or those that the mixture gives them. Throws std::invalid_argument if the spheres jam
// before they are full-grown.
std::vector<Vector> grown_positions(std::uint32_t count, const Box& box, std::uint64_t seed,
                                    const std::optional<Mixture>& mixture = {});

}  // namespace haff::engine
