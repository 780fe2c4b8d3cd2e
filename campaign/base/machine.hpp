// What this machine offers.
#pragma once

#include "schema/grid.hpp"

namespace haff::campaign {

int processors();                 // that this process may use
schema::Memory machine_memory();  // and what a particle of a running job takes of it

}  // namespace haff::campaign
