// SPDX-License-Identifier: GPL-3.0-or-later

// Averages over realizations that were not all computed with the same bits.
#pragma once

#include <string>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::campaign {

// A sentence about each series whose finished realizations are of more than one physics version
// (engine::physics_version). None, as a rule.
std::vector<std::string> mixed_physics(const schema::Reader& store);

}  // namespace haff::campaign
