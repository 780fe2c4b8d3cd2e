// SPDX-License-Identifier: GPL-3.0-or-later

// One row of samples: what a gas shows now, and what it did since the row before.
#pragma once

#include <span>
#include <vector>

#include "engine/simulation.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

// Takes the sample of a job at tau, and the engine's tally with it. `earlier` are the rows before,
// all or at least the last three; none at the start. What each column is averaged over:
//   temperature, a_l, rotational and species temperatures, and what goes with profiles   the
//                    moment of the sample
//   gamma_ratio      the interval since the row before, over tau: exact, from ln T at its ends
//   collision_rate   the same interval, over time: exact, a number of collisions over the time
//   pressure         the same interval, over time: n <T> + virial / (d V dt), the collisional part
//                    exact, the kinetic part by analysis::mean_temperature
// What does not exist (a rate at the start, a coefficient of a gas at rest) stays empty.
schema::Sample measure(engine::Simulation& gas, const schema::Job& job, double tau,
                       std::span<const schema::Sample> earlier);

// Only the columns that hold for the moment, at tau; the tally stays.
schema::Sample measure_moment(const engine::Simulation& gas, const schema::Job& job, double tau);

// The end of the homogeneous stage, from all samples of a job.
schema::Results results(const std::vector<schema::Sample>& samples, const schema::Job& job);

// Whether a_2, a_3 and a_4 are those of elastic equilibrium, by analysis::is_equilibrated.
bool is_equilibrated(const schema::Sample& sample, const schema::Job& job);

}  // namespace haff::campaign
