// SPDX-License-Identifier: GPL-3.0-or-later

// The position of a trajectory in time and collisions, and its counters so far.
#pragma once

#include <cstdint>

#include "engine/state.hpp"

namespace haff::engine {

struct Clock {
  std::int64_t collisions = 0;
  double now = 0;    // since the last synchronization, in scaled units
  double start = 0;  // true time of the last synchronization
  int exponent = 0;  // true velocity = velocity * 2^-exponent, true time = now * 2^exponent
  Tally tally;       // since then, or since it was last taken; in scaled units
  Tally before;      // the part that had not been taken by the last synchronization
  Invariants invariants;
  double energy = 0;  // kinetic, per particle, at the last synchronization, in scaled units
  double taken = 0;   // part of the loss since then that is no longer in the tally

  double time() const;               // true time
  double scaled(double time) const;  // `now` at this true time
};

// Kinetic energy of rotation per particle, in scaled units.
struct Rotation {
  double before = 0;  // at the last synchronization
  double now = 0;
};

}  // namespace haff::engine
