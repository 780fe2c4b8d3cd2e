// SPDX-License-Identifier: GPL-3.0-or-later

// A cooling job: an equilibrated gas loses energy until tau_max.
#pragma once

#include "campaign/job/attempt.hpp"

namespace haff::campaign {

Ending cool(Attempt& attempt);

}  // namespace haff::campaign
