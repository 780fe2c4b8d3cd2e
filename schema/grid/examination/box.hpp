// SPDX-License-Identifier: GPL-3.0-or-later

// Whether the particles of a grid fit into their box, the box into the machine, and whether such a
// gas can be prepared. Private to schema/.
#pragma once

#include <string>

#include "schema/grid/grid.hpp"
#include "schema/grid/source.hpp"

namespace haff::schema {

// Throws GridError where a box is too small or the machine is.
void must_fit(const std::string& file, const Source& source, const Memory& memory);

// Throws GridError where a gas is denser than close packing, or where `cannot_start` says why it
// cannot be prepared.
void must_be_packable(const std::string& file, const Source& source, const Refusal& cannot_start);

}  // namespace haff::schema
