// SPDX-License-Identifier: GPL-3.0-or-later

// Three counters that end a simulation which makes no progress.
//
// Inelastic collapse (S. McNamara and W. R. Young, Phys. Fluids A 4, 496 (1992)): infinitely many
// collisions within a finite time, while the relative speeds and gaps in a group of spheres shrink
// geometrically, for example three in a line below e = 7 - 4 sqrt(3). Numbers of finite precision
// cannot follow a collapse, and at constant e it has no continuation.
//   - Slow collisions in quick succession: in a collapse, relative speeds and the intervals between
//     collisions fall below any bound; otherwise they never do.
//   - A stalled period: the collisions between two synchronizations took no time.
//   - A period that lasts too long: no more collisions come.
#pragma once

#include "engine/loop/gas.hpp"
#include "engine/soundness.hpp"

namespace haff::engine {

// A collision whose r.v is smaller than this is about to be too slow to be resolved; it is still
// two decades above that limit (smallest_approach). By chance r.v / speed < x has probability x^2
// (grazing): 1e-24 per collision, 1e-14 in a local region a hundred thousand times slower than the
// rest. [sigma * scaled speed]
inline constexpr double slow_approach = 1e-12;

// A period between synchronizations is stalled if it is shorter than this fraction of the period
// expected from Boltzmann's collision rate: only spheres compressed to within 1e-8 of close packing
// collide that often, and no fluid or crystal made here does.
inline constexpr double stalled_period = 1e-9;

// A slow collision counts if both partners have collided within this fraction of the expected
// period.
inline constexpr double quick_succession = 1e-6;

// A period that is longer than this many expected ones is given up: particles that have not met by
// then never will. Within a period, the coldest gas (e = 0) slows down by a factor of some 5; two
// or three particles, whose energy can vanish in one collision, slow down by much more, and waiting
// for them costs nothing.
double longest_period(std::uint32_t particles);

// The length of the period that is about to begin, from Boltzmann's collision rate, in scaled time.
double expected_period(const Gas& gas);

// Counts a collision of p and q slower than slow_approach, where one of the two had not collided
// `since` that time. Throws Collapse when there are too many.
void note_slow_collision(Gas& gas, std::uint32_t p, std::uint32_t q, double since);

// Called at the end of a period, before the synchronization. Throws Collapse if it took no time.
void must_have_progressed(const Gas& gas, double expected);

}  // namespace haff::engine
