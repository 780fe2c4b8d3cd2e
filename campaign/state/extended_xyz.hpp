// SPDX-License-Identifier: GPL-3.0-or-later

// A gas as extended XYZ, which ASE, OVITO and chemfiles read: a line with the number of particles,
// a line with the cell, the columns and what else is known, and a line for each particle.
//
//   species           H, and He for species 2 of a mixture: the readers want names of elements
//   pos, velo         [sigma], [sqrt(E(0)/m)]; in order of id
//   radius, mass, id
//   omega             angular velocity of rough particles [sqrt(E(0)/m)/sigma]
//
// Numbers have all their digits, so that the same state is read back. Several of them, one after
// the other, are a trajectory.
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "engine/state.hpp"

namespace haff::campaign {

// `facts`: further "key=value" of the second line, with blanks between them.
void write_xyz(const engine::State& state, const std::string& facts, std::ostream& out);

// A text in quotes, as a value of that line.
std::string quoted_for_xyz(const std::string& text);

// What a file says, in the order of its lines. Columns that it does not have are empty.
struct Frame {
  std::array<double, 3> side{};    // of the cell, whose axes are x, y and z [sigma]
  std::array<double, 3> origin{};  // of the cell
  std::array<bool, 3> is_periodic{true, true, true};
  std::vector<engine::Vector> position, velocity, angular_velocity;
  std::vector<double> radius, mass;
  std::vector<std::string> species;
  std::vector<std::uint32_t> id;
};

// Reads one gas, with columns in any order: pos and velo (or vel) must be there, and their numbers
// must be finite. Throws std::invalid_argument, which names the line, if there is no gas, or
// several.
Frame read_xyz(std::istream& in);

}  // namespace haff::campaign
