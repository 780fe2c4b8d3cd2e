// SPDX-License-Identifier: GPL-3.0-or-later

// The energy of a gas in its state and in its samples: whether the two can belong together.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/state.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

// An elastic gas keeps its energy except for rounding, a random 1e-16 at each collision. [relative]
inline constexpr double elastic_drift = 1e-9;

// Below 1e-308, some 700 e-foldings of cooling, doubles have fewer digits the smaller they are,
// down to none. The energy of a sample is a sum of at most three of them, each with a rounding of
// its own: two such energies that differ by less are equal. [E(0)]
inline constexpr double smallest_energy = 8 * std::numeric_limits<double>::denorm_min();

// 2/d times the energy per particle, of translation and, for rough spheres, of rotation. Collisions
// cannot increase it. [E(0)]
double total_energy(const schema::Sample& sample, const schema::Job& job);  // needs its temperature
double total_energy(const engine::State& state, const schema::Job& job);

// Only a heated gas may grow warmer.
bool is_heated(const schema::Job& job);

// What is wrong with the energy of a state of this job, or nothing. It is compared with the sample
// at the same tau and, in a gas that only cools, with the samples around it; without samples of the
// temperature, with the energy that was put in.
std::optional<std::string> energy_contradiction(const engine::State& state, const schema::Job& job,
                                                const std::vector<schema::Sample>& samples);

}  // namespace haff::campaign
