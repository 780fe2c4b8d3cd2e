// SPDX-License-Identifier: GPL-3.0-or-later

// Whether a state can be that of a gas of hard spheres (finite, inside its box, without overlaps),
// and how large the invariants of a run may be.
#pragma once

#include <optional>
#include <string>

#include "state.hpp"

namespace haff::engine {

// Rounding of positions and contact times lets spheres overlap by some 1e-14 sigma in the largest
// boxes. This is ten thousand times as much, and still far from anything physical. [sigma]
inline constexpr double smallest_allowed_overlap = 1e-10;

// The overlap allowed in a gas of number density n. A contact is predicted from where the two
// particles last collided, and the discriminant of a pair at distance r is rounded by some 1e-16
// r^2 v^2. In very dilute gases, where a flight can be some ten mean free paths, this dominates
// (measured: 3e-8 at n = 1e-4). `periods`: the length of the period in units of the expected one.
// [sigma]
double allowed_overlap(double n, double periods = 1, int d = 3);

// In a smaller box a sphere could touch another one and its image at the same time. [sigma]
inline constexpr double smallest_box = 2;

// The energy lost in the collisions of a period, and the kinetic energies before and after it, are
// sums of some N terms, each rounded to 1e-16 of itself: the error is below 1e-16 N at worst, and
// 1e-16 sqrt(N) as measured. [relative to the energy]
inline constexpr double allowed_energy_mismatch = 1e-11;

// Rounding in collisions adds up to 1e-15 of sqrt(N) rms speeds between two synchronizations. The
// sum over all particles is less exact: it runs along a curve through space, and where velocities
// are correlated its partial sums grow to N times the speed of the streams, not sqrt(N), each
// rounded to 1e-16 of itself. This gives some 1e-17 N, and 1e-12 as measured at N = 6 10^5 in the
// clustering stage. The momentum allowed here carries 1e-18 of the energy; a single collision that
// did not conserve momentum would leave 1/sqrt(N).
inline constexpr double allowed_momentum = 1e-9;

// This many collisions too slow to be resolved (loop/watchdog.hpp) are an inelastic collapse. A
// single one may occur by chance in a very long run.
inline constexpr std::int64_t unresolved_collisions_of_a_collapse = 3;

// The deepest overlap seen at a collision. [sigma]
double largest_overlap(const Invariants& invariants);

// Says what is wrong with the state; nothing if it is sound.
std::optional<std::string> unsoundness(const State& state);

// Says what is wrong with a run that has these invariants; nothing if it is sound.
std::optional<std::string> violation(const Invariants& invariants, double allowed_overlap);

}  // namespace haff::engine
