// SPDX-License-Identifier: GPL-3.0-or-later

// Samples at moments of time, taken between two collisions.
//
// A time falls on a different collision in every realization, so that these cannot be rows of
// samples, which are averaged at equal tau. They are points of curves of their own, and x is the
// time: it is equal in all realizations, and exact, since no velocity changes between two
// collisions.
#pragma once

#include <vector>

#include "engine/simulation.hpp"
#include "schema/grid/job.hpp"
#include "schema/rows/measured.hpp"

namespace haff::campaign {

// A point, at the time asked for, of each curve (tau_at_time, temperature_at_time, a2_at_time ...)
// that the job's observables make of the gas as it is.
std::vector<schema::Profile> measure_at_time(const engine::Simulation& gas, const schema::Job& job,
                                             double time);

}  // namespace haff::campaign
