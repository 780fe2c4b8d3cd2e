// A cooling job: an equilibrated gas loses energy until tau_max.
#pragma once

#include "campaign/attempt.hpp"

namespace haff::campaign {

Ending cool(Attempt& attempt);

}  // namespace haff::campaign
