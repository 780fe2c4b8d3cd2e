// Initial states: spheres that do not overlap, Gaussian velocities, zero total momentum.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "engine/simulation.hpp"

namespace haff::engine {

// N spheres at number density n in a periodic cube, on a face-centred cubic lattice where one
// fits and grown into place (Lubachevsky and Stillinger) where none does; disks (d = 2) in a
// square, on a triangular lattice or grown. Kinetic energy per particle 1. Depends on (n,
// particles, seed, d) only, and on a mixture if there is one among the model's effects: it decides
// who is small and light. Throws Breakdown if growth jams below n.
State initial_state(double n, std::uint32_t particles, std::uint64_t seed, int d = 3,
                    const std::map<std::string, Parameters>& effects = {});

// The same configuration as the start of a new run: velocities scaled so that the kinetic energy
// per particle is exactly 1 (to rounding), clocks and tallies at zero.
State restarted(const State& state);

}  // namespace haff::engine
