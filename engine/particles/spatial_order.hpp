// SPDX-License-Identifier: GPL-3.0-or-later

// The order of the particles in memory: along a space-filling curve, so that neighbours in space
// are neighbours in memory.
#pragma once

#include <span>

#include "engine/particles/box.hpp"
#include "engine/particles/particle.hpp"
#include "engine/support/team.hpp"

namespace haff::engine {

// Sorts the particles along the Z curve (G. M. Morton, 1966) through 1024^3 boxes. Particles in the
// same box keep their order.
void sort_in_space(std::span<Particle> particles, const Box& box, Team& team);
inline void sort_in_space(std::span<Particle> particles, const Box& box) {
  Team alone;
  sort_in_space(particles, box, alone);
}

}  // namespace haff::engine
