// What this machine offers.
#pragma once

#include "schema/grid.hpp"

namespace haff::campaign {

// That this process may use: of its affinity mask, and of the CPU quotas of its cgroups, rounded
// up.
int processors();

schema::Memory machine_memory();  // and what a particle of a running job takes of it

}  // namespace haff::campaign
