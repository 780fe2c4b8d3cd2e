// SPDX-License-Identifier: GPL-3.0-or-later

// The energy of a gas, in its state and in its samples: whether one can be the other's.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/state.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

// An elastic gas keeps its energy but for rounding, some 1e-16 a collision at random. [relative]
inline constexpr double elastic_drift = 1e-9;

// Below 1e-308, some 700 e-foldings of cooling, doubles have fewer digits the smaller they are,
// down to none. The energy of a sample is a sum of at most three of them, each with a rounding of
// its own: two such energies that differ by less are equal. [E(0)]
inline constexpr double smallest_energy = 8 * std::numeric_limits<double>::denorm_min();

// (2/d) of the energy per particle, of translation and, in rough spheres, rotation: what collisions
// cannot make more. [E(0)]
double total_energy(const schema::Sample& sample, const schema::Job& job);  // needs its temperature
double total_energy(const engine::State& state, const schema::Job& job);

// Only a heated gas may grow warmer.
bool is_heated(const schema::Job& job);

// What is wrong with the energy of a state of this job, or nothing. It is held against the sample
// at the same tau and, in a gas that only cools, against the samples around it; without samples of
// the temperature, against the energy that was put in.
std::optional<std::string> energy_contradiction(const engine::State& state, const schema::Job& job,
                                                const std::vector<schema::Sample>& samples);

}  // namespace haff::campaign
