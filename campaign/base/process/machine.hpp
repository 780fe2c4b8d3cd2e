// SPDX-License-Identifier: GPL-3.0-or-later

// What this machine offers.
#pragma once

#include "schema/grid/grid.hpp"

namespace haff::campaign {

// Processors that this process may use, by its affinity mask and by the CPU quotas of its cgroups,
// rounded up.
int processors();

// Memory that this process and its workers may use: the machine's, or the limit of its cgroups.
double memory_bytes();

// The same, and how much of it a particle of a running job needs at least.
schema::Memory machine_memory();

}  // namespace haff::campaign
