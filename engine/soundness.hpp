// Whether a state can be one of a gas of hard spheres: finite, in its box, nothing overlapping. And
// what the invariants that a run counts may be at most.
#pragma once

#include <optional>
#include <string>

#include "engine/state.hpp"

namespace haff::engine {

// Spheres may overlap by what rounding of positions and contact times leaves: some 1e-14 sigma in
// the largest boxes, so this is ten thousand times that, and still far from anything physical.
// [sigma]
inline constexpr double smallest_allowed_overlap = 1e-10;

// In a gas of number density n. A contact is predicted from where the two last collided, and the
// discriminant of a pair r apart is rounded by some 1e-16 r^2 v^2: in very dilute gases, where a
// flight can be some ten mean free paths, that is what counts (3e-8 at n = 1e-4, as measured).
// `periods`: how many times longer than expected a period was. [sigma]
double allowed_overlap(double n, double periods = 1, int d = 3);

// Below this side of the box a sphere would meet another one and its image at once. [sigma]
inline constexpr double smallest_box = 2;

// The loss summed over the collisions of a period, and the kinetic energies before and after it,
// are sums of some N terms, each rounded to 1e-16 of it: together below 1e-16 N at worst, 1e-16
// sqrt(N) as measured. [relative to the energy]
inline constexpr double allowed_energy_mismatch = 1e-11;

// What rounding adds to the total momentum between two synchronizations is a random walk of some
// 10 N steps of 1e-16, some 1e-15 of sqrt(N) rms speeds at the beginning. Of the size allowed it
// carries 1e-24 of the energy.
inline constexpr double allowed_momentum = 1e-12;

// So many collisions too slow to be resolved (watchdog.hpp) are an inelastic collapse; one may be
// chance in the longest of runs.
inline constexpr std::int64_t trips_of_a_collapse = 3;

// Deepest overlap seen at a collision. [sigma]
double largest_overlap(const Invariants& invariants);

// What is wrong with the state, or nothing.
std::optional<std::string> unsoundness(const State& state);

// What is wrong with a run that has counted these, or nothing.
std::optional<std::string> violation(const Invariants& invariants, double allowed_overlap);

}  // namespace haff::engine
