// SPDX-License-Identifier: GPL-3.0-or-later

// A gas as extended XYZ, which ASE, OVITO and chemfiles read: a line with the number of particles,
// a line with the cell, the columns and what else is known, and a line for each particle.
//
//   species           H, and He for species 2 of a mixture: the readers want names of elements
//   pos, velo         [sigma], [sqrt(E(0)/m)]; in order of id
//   radius, mass, id
//   angular_velocity  of rough particles, the speed of the surface [sqrt(E(0)/m)]
//
// Numbers have all their digits: what is read back is the same state. Several of them, one after
// the other, are a trajectory.
#pragma once

#include <iosfwd>
#include <string>

#include "engine/state.hpp"

namespace haff::campaign {

// `facts`: further "key=value" of the second line, with blanks between them.
void write_xyz(const engine::State& state, const std::string& facts, std::ostream& out);

// As a value in that line: a text in quotes.
std::string quoted_for_xyz(const std::string& text);

}  // namespace haff::campaign
