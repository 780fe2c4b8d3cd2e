// SPDX-License-Identifier: GPL-3.0-or-later

// Initial states: spheres that do not overlap, Gaussian velocities, zero total momentum.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "simulation.hpp"

namespace haff::engine {

// Spheres at number density n in a periodic cube: on a face-centred cubic lattice if it fits,
// otherwise grown into place (Lubachevsky and Stillinger). With d = 2, disks in a square: on a
// triangular lattice, or grown. The kinetic energy per particle is 1. The state depends only on
// (n, particles, seed, d) and on the mixture, if the model's effects name one: the mixture decides
// which particles are small and light, and small particles grow to their own size only. Throws
// std::invalid_argument if growth jams below n.
State initial_state(double n, std::uint32_t particles, std::uint64_t seed, int d = 3,
                    const std::map<std::string, Parameters>& effects = {});

// The side of the periodic box, (particles/n)^(1/d), computed with IEEE operations alone: the C
// library's cube root differs in its last bit between machines. [sigma]
double box_side(double n, std::uint32_t particles, int d);

// Whether such a state begins on a lattice. Growth takes much longer and can jam: it succeeds up to
// a volume fraction of some 0.64 for spheres and 0.84 for disks.
bool begins_on_lattice(double n, std::uint32_t particles, int d);

// The same configuration as the start of a new run: the velocities are scaled so that the kinetic
// energy per particle is 1 (up to rounding), and clocks and tallies are zero.
State restarted(const State& state);

}  // namespace haff::engine
