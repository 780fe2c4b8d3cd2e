// SPDX-License-Identifier: GPL-3.0-or-later

// Where a cooling job starts from: the equilibrated gas, changed as its start says, or a state of
// the user's own.
#pragma once

#include "campaign/state/extended_xyz.hpp"
#include "engine/state.hpp"
#include "schema/grid/job.hpp"

namespace haff::campaign {

// The first state after the equilibration: at time 0, without momentum, with an energy per particle
// of
// 1. Two starts change the velocities c of the equilibrated gas:
//
//   shear wave        v = f c + A sin(2 pi waves y / L) e_x, less the mean of the sine; f is such
//                     that the energy is 1
//   two temperatures  the mean velocity of each group is taken away, and each is scaled to its
//                     temperature: their ratio is exact, and neither flows
//
// Only + - * / and square roots are used: the bits are the same on every machine.
engine::State first_state(const engine::State& equilibrated, const schema::Start& start);

// The state that a file holds as one of this job: its box is the job's, its momentum is taken away,
// velocities (and spins of rough particles) are scaled so that the energy per particle is 1. Throws
// std::invalid_argument if it is not a sound one of this job's gas.
engine::State given_state(const Frame& frame, const schema::Job& job);

}  // namespace haff::campaign
