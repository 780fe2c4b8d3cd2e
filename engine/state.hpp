// SPDX-License-Identifier: GPL-3.0-or-later

// The state of a gas at a synchronization: every particle at the same instant.
//
// A checkpoint holds a state; a simulation starts from a state and returns one. Units (m = sigma =
// 1, and energy per particle 1 at the start): length sigma, mass m, time sigma sqrt(m/E(0)).
// Velocities are scaled so that the thermal speed stays near 1: the true velocity is velocity *
// 2^-exponent, exactly (particles/synchronize.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace haff::engine {

using Vector = std::array<double, 3>;

// Sums over the collisions since the tally was last taken, in the units of the velocities.
struct Tally {
  double dissipated = 0;  // kinetic energy lost, summed collision by collision
  double virial = 0;      // sum of sigma * |momentum transfer|; p = nT + virial / (d V time)

  bool operator==(const Tally&) const = default;
};

// Counters that show whether the physics held; every run keeps them from its start. soundness.hpp
// says how large they may be, and why.
struct Invariants {
  double closest2 = 1;                     // smallest squared distance at a collision [sigma^2]
  std::int64_t past_events = 0;            // events whose time had passed when their turn came
  std::int64_t unresolved_collisions = 0;  // collisions too slow to be resolved (loop/watchdog.hpp)
  // Largest |energy lost in collisions - change of kinetic energy| between two synchronizations,
  // relative to that energy.
  double energy_mismatch = 0;
  double momentum_removed = 0;  // largest |sum of m v| set to zero, / (sqrt(N) * rms speed)

  bool operator==(const Invariants&) const = default;
};

struct State {
  int d = 3;       // dimension; for disks (2) all z are 0
  double box = 0;  // side L of the periodic cube or square

  // One entry per particle, in spatial order (particles/spatial_order.hpp). The id of a particle
  // never changes; its place in these arrays does.
  std::vector<std::uint32_t> id;
  std::vector<Vector> position;  // in [0, L)
  std::vector<Vector> velocity;  // scaled by 2^exponent
  int exponent = 0;

  std::int64_t collisions = 0;  // pair collisions C since the start; tau = 2 C / N
  double time = 0;              // true time since the start
  Tally tally;                  // in scaled units, like the velocities
  Invariants invariants;

  // The memory of a restitution model or an effect from one collision or action to the next, by
  // name. Most have none.
  std::map<std::string, std::vector<double>> memory;

  std::uint32_t particles() const { return static_cast<std::uint32_t>(id.size()); }
  bool operator==(const State&) const = default;
};

}  // namespace haff::engine
