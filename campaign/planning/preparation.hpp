// SPDX-License-Identifier: GPL-3.0-or-later

// Whether the engine can prepare a gas: on a lattice, or by growth.
#pragma once

#include <optional>
#include <string>

#include "schema/grid/grid.hpp"

namespace haff::campaign {

// Why it cannot, e.g. "disks at n = 1.1 ...; expected N = 98 or 104", or nothing. Growth depends on
// the seed as well: up to the packing that is let pass here, all the gases that were tried came to
// their density (tests/campaign/planning/preparation.cpp).
std::optional<std::string> why_not_prepared(const schema::Preparation& gas);

}  // namespace haff::campaign
