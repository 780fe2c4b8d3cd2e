// Synchronization: all particles brought to one time, and everything that grows put back.
//
// It happens at fixed collision numbers, whether or not anybody stores the state, so an
// interrupted run continues bit for bit. Four things are done, each deterministic:
//   - positions advance to now and are wrapped into the box; local clocks restart at zero, which
//     keeps event times short however long the gas has cooled;
//   - rounding feeds a total momentum that does not cool and would carry all the energy near
//     T/T0 = 1e-32: it is set to zero again, and the amount recorded;
//   - when the gas has cooled, velocities are multiplied by a power of two (exact, and so is the
//     inverse scaling of time), so that numbers stay near 1 down to any temperature;
//   - particles are sorted along a space-filling curve, so that neighbours in space are neighbours
//     in memory. The curve depends on the box only: the order is part of the physics' bits (sums
//     run along it), cell size is not.
#pragma once

#include <span>
#include <vector>

#include "engine/particle.hpp"

namespace haff::engine {

// Where a trajectory stands between two synchronizations.
struct Clock {
  std::int64_t collisions = 0;
  double now = 0;    // since the last synchronization, in scaled units
  double start = 0;  // true time of the last synchronization
  int exponent = 0;  // true velocity = velocity * 2^-exponent, true time = now * 2^exponent
  Tally tally;       // in scaled units
  double momentum_removed = 0;

  double time() const;  // true
};

void synchronize(std::span<Particle> particles, Clock& clock, const Box& box);

// The image of a position that lies in [0, L).
Vector wrapped(Vector position, const Box& box);

// Sorts along the Z curve (G. M. Morton, 1966) through 1024^3 boxes, ties in the order found.
void sort_in_space(std::span<Particle> particles, const Box& box);

// Sets the total momentum to zero; returns its size relative to sqrt(N) times the rms speed.
double remove_momentum(std::span<Particle> particles);

// Kinetic energy per particle, in the units of the velocities.
double kinetic_energy(std::span<const Particle> particles);

// Records to state and back, particle by particle.
State to_state(std::span<const Particle> particles, const Clock& clock, const Box& box);
void copy_particles(const State& state, std::span<Particle> particles);
Clock to_clock(const State& state);

// The collision number of the first synchronization after `collisions`.
std::int64_t next_synchronization(std::int64_t collisions, std::uint32_t particles);

}  // namespace haff::engine
