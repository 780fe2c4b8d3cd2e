// SPDX-License-Identifier: GPL-3.0-or-later

// An equilibration: an elastic gas collides until it has forgotten its lattice.
//
// It ends at the first synchronization at or after tau = equilibrate at which a_2, a_3 and a_4 have
// their values in equilibrium, and goes on from synchronization to synchronization until then.
#pragma once

#include <stdexcept>

#include "campaign/job/attempt.hpp"

namespace haff::campaign {

// A gas that is not in equilibrium after so many times `equilibrate` never will be.
inline constexpr double longest_equilibration = 4;

struct NotEquilibrated : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The state came from a file and is damaged now: it cannot be computed again.
struct StateWasGiven : std::runtime_error {
  StateWasGiven()
      : std::runtime_error(
            "its state came from a file, and cannot be computed; plan the grid that names the file "
            "again, and the state is there again") {}
};

// The equilibration of a crystal is its first state, at once.
Ending equilibrate(Attempt& attempt);

}  // namespace haff::campaign
