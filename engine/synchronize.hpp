// Synchronization: all particles brought to one time, and everything that grows put back.
//
// It happens at fixed collision numbers, whether or not anybody stores the state, so an
// interrupted run continues bit for bit. Four things are done, each deterministic:
//   - positions advance to now and are wrapped into the box; local clocks restart at zero, which
//     keeps event times short however long the gas has cooled;
//   - rounding feeds a total momentum that does not cool and would carry all the energy near
//     T/T0 = 1e-32: it is set to zero again, and the amount recorded;
//   - when the gas has cooled or been heated, velocities are multiplied by a power of two (exact,
//     and so is the inverse scaling of time), so that numbers stay near 1 at any temperature;
//   - particles are sorted along a space-filling curve, so that neighbours in space are neighbours
//     in memory. The curve depends on the box only: the order is part of the physics' bits (sums
//     run along it), cell size is not.
#pragma once

#include <span>
#include <vector>

#include "engine/clock.hpp"
#include "engine/masses.hpp"
#include "engine/particle.hpp"

namespace haff::engine {

// The clock of a gas that is about to start from these particles: scaled, its energy noted.
template <class Masses = EqualMasses>
void start(std::span<Particle> particles, Clock& clock, const Masses& masses = {});

// The tally in true units; starts it anew.
Tally take_tally(Clock& clock);

// Before a synchronization: has the kinetic energy changed by what was lost in collisions, and are
// all invariants as they may be (soundness.hpp)? Notes the one, throws Breakdown if not the other.
template <class Masses = EqualMasses>
void audit(std::span<const Particle> particles, Clock& clock, double allowed_overlap,
           const Masses& masses = {}, const Rotation& rotation = {});

template <class Masses = EqualMasses>
void synchronize(std::span<Particle> particles, Clock& clock, const Box& box,
                 const Masses& masses = {});

// The image of a position that lies in [0, L).
Vector wrapped(Vector position, const Box& box);

// Sorts along the Z curve (G. M. Morton, 1966) through 1024^3 boxes, ties in the order found.
void sort_in_space(std::span<Particle> particles, const Box& box);

// Sets the total momentum to zero; returns its size relative to sqrt(N) times the rms speed (the
// rms of sqrt(m) v, times sqrt of the mean mass).
template <class Masses = EqualMasses>
double remove_momentum(std::span<Particle> particles, const Masses& masses = {});

// Kinetic energy of translation per particle, in the units of the velocities.
template <class Masses = EqualMasses>
double kinetic_energy(std::span<const Particle> particles, const Masses& masses = {});

// Records to state and back, particle by particle.
State to_state(std::span<const Particle> particles, const Clock& clock, const Box& box);
void copy_particles(const State& state, std::span<Particle> particles);
Clock to_clock(const State& state);

// The first collision number after `collisions` at which tau is (k + phase) period, k = 0, 1, ...
std::int64_t next_at(std::int64_t collisions, std::size_t particles, double period,
                     double phase = 0);

// That of the first synchronization.
std::int64_t next_synchronization(std::int64_t collisions, std::size_t particles);

}  // namespace haff::engine
