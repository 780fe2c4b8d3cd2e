// SPDX-License-Identifier: GPL-3.0-or-later

// Synchronization: brings all particles to one time, and resets all numbers that would grow.
//
// It happens at fixed collision numbers, whether or not the state is stored, so an interrupted run
// continues bit for bit. It does four things, each of them deterministic:
//   - Positions advance to the present time and are wrapped into the box; the particles' clocks
//     restart at zero. This keeps event times short however long the gas has cooled.
//   - Rounding creates a total momentum that does not cool, and that would carry all the energy
//     near T/T0 = 1e-32. The momentum is set to zero, and the amount is recorded.
//   - When the gas has cooled or has been heated, the velocities are multiplied by a power of two,
//     so that numbers stay near 1 at any temperature. This is exact, and so is the inverse scaling
//     of time.
//   - The particles are sorted along a space-filling curve (spatial_order.hpp). The curve depends
//     on the box alone: the order is part of the trajectory's bits, since sums run along it; the
//     size of the cells is not.
#pragma once

#include <span>
#include <vector>

#include "engine/particles/box.hpp"
#include "engine/particles/clock.hpp"
#include "engine/particles/masses.hpp"
#include "engine/particles/particle.hpp"
#include "engine/support/team.hpp"

namespace haff::engine {

// Prepares the clock of a gas that is about to start from these particles: scales the velocities
// and records the energy.
template <class Masses = EqualMasses>
void start(std::span<Particle> particles, Clock& clock, const Masses& masses = {});

// Returns the tally in true units and resets it.
Tally take_tally(Clock& clock);

// Called before a synchronization. Compares the change of the kinetic energy with the energy lost
// in collisions and records the mismatch. Throws PhysicsError if an invariant exceeds what is
// allowed (soundness.hpp).
template <class Masses = EqualMasses>
void audit(std::span<const Particle> particles, Clock& clock, double allowed_overlap,
           const Masses& masses = {}, const Rotation& rotation = {});

// Sums over particles are not divided among the threads: they run in the order of memory.
template <class Masses = EqualMasses>
void synchronize(std::span<Particle> particles, Clock& clock, const Box& box, const Masses& masses,
                 Team& team);
template <class Masses = EqualMasses>
void synchronize(std::span<Particle> particles, Clock& clock, const Box& box,
                 const Masses& masses = {}) {
  Team alone;
  synchronize(particles, clock, box, masses, alone);
}

// The image of a position in [0, L).
Vector wrapped(Vector position, const Box& box);

// Sets the total momentum to zero. Returns the momentum that was there, relative to sqrt(N) times
// the rms speed (the rms of sqrt(m) v, times the root of the mean mass).
template <class Masses = EqualMasses>
double remove_momentum(std::span<Particle> particles, const Masses& masses = {});

// Kinetic energy of translation per particle, in the units of the velocities.
template <class Masses = EqualMasses>
double kinetic_energy(std::span<const Particle> particles, const Masses& masses = {});

// Copies records to a state and back, particle by particle.
State to_state(std::span<const Particle> particles, const Clock& clock, const Box& box);
void copy_particles(const State& state, std::span<Particle> particles);
Clock to_clock(const State& state);

// The first collision number after `collisions` at which tau has reached (k + phase) period for
// some k = 0, 1, ...
std::int64_t next_at(std::int64_t collisions, std::size_t particles, double period,
                     double phase = 0);

// The collision number of the next synchronization after `collisions`.
std::int64_t next_synchronization(std::int64_t collisions, std::size_t particles);

}  // namespace haff::engine
