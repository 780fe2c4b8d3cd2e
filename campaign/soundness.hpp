// Whether a state can be one of a gas of hard spheres: finite, in its box, nothing overlapping.
#pragma once

#include <optional>
#include <string>

#include "engine/state.hpp"

namespace haff::campaign {

// Spheres may overlap by what rounding of positions and contact times leaves: some 1e-14 sigma in
// the largest boxes, so this is ten thousand times that, and still far from anything physical.
// [sigma]
inline constexpr double allowed_overlap = 1e-10;

// What is wrong with the state, or nothing.
std::optional<std::string> unsoundness(const engine::State& state);

}  // namespace haff::campaign
