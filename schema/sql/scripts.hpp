// SPDX-License-Identifier: GPL-3.0-or-later

// The scripts 001-....sql, 002-....sql. A store's version is how many of them it has seen. Private
// to schema/.
#pragma once

#include <string_view>
#include <vector>

namespace haff::schema {

// All scripts, in their order. The last one, with which every store comes to the newest version,
// also makes the views that average anew. A change of these views therefore needs a new script:
// otherwise stores with the earlier views count as changed by another program.
std::vector<std::string_view> scripts();

// The version of a store that has seen this script, and none after it.
int version_with(std::string_view script);

}  // namespace haff::schema
