// SPDX-License-Identifier: GPL-3.0-or-later

// Lattices of spheres and disks: the positions of the particles of a new gas, if the lattice fits.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/particles/box.hpp"

namespace haff::engine {

// `count` sites of a face-centred cubic lattice (of a triangular lattice if the box is a square)
// that fills the box; vacant sites are spread evenly. Nothing if neighbours would be closer than
// sigma.
std::optional<std::vector<Vector>> lattice_positions(std::uint32_t count, const Box& box);

// Whether there is such a lattice.
bool lattice_fits(std::uint32_t count, const Box& box);

}  // namespace haff::engine
