// SPDX-License-Identifier: GPL-3.0-or-later

// One particle, one cache line.
//
// A record changes only when its particle collides or when the gas is synchronized. Between these
// events the particle moves in a straight line, and its present position follows from the record.
// Nothing else writes to a record, so a trajectory cannot depend on when it was read.
//
// Disks (d = 2) are spheres with z = 0 and v_z = 0: a pair of disks gives the bits that x and y
// alone would give.
#pragma once

#include <cstdint>

#include "engine/state.hpp"
#include "engine/support/arithmetic.hpp"

namespace haff::engine {

struct alignas(64) Particle {
  Vector position;  // at its own time; not wrapped until the next synchronization
  double time;      // since the last synchronization
  Vector velocity;
  std::uint32_t id;       // never changes
  std::uint32_t changes;  // collisions since the last synchronization
};
static_assert(sizeof(Particle) == 64);

}  // namespace haff::engine
