// How fast this machine collides a gas, and how much memory that takes: a short trial.
#pragma once

#include <cstdint>

namespace haff::campaign {

struct Calibration {
  double collisions_per_second = 0;
  double bytes_per_particle = 0;
};

// Runs an elastic gas for some `seconds` of CPU time. Large gases are tried at 200 000 particles,
// beyond which speed hardly changes; crowded ones at n = 0.9, where a lattice can be had at once.
Calibration calibrate(int d, double n, std::uint32_t particles, double seconds);

}  // namespace haff::campaign
