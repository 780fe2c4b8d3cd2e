// SPDX-License-Identifier: GPL-3.0-or-later

// Samples at moments of time: what the gas shows between two collisions, when a time has come.
//
// A time falls on another collision in every realization, so that these are no rows of samples,
// which are averaged at equal tau. They are points of curves of their own, of which x is the time:
// equal in all realizations, and exact, since no velocity changes between two collisions.
#pragma once

#include <vector>

#include "engine/simulation.hpp"
#include "schema/grid/job.hpp"
#include "schema/rows/measured.hpp"

namespace haff::campaign {

// A point of each curve (tau_at_time, temperature_at_time, a2_at_time ...) that the job's
// observables make, of the gas as it is, at the time asked for.
std::vector<schema::Profile> measure_at_time(const engine::Simulation& gas, const schema::Job& job,
                                             double time);

}  // namespace haff::campaign
