// SPDX-License-Identifier: GPL-3.0-or-later

// The collision rate that Enskog's theory expects of a homogeneous gas: how often a particle
// collides in a unit of time. In a mixture chi is that of equal particles of the same packing
// fraction.
#pragma once

#include "schema/grid/job.hpp"

namespace haff::campaign {

// Averaged over the particles. Throws std::invalid_argument where particles fill all of the box.
double expected_collision_rate(const schema::Job& job, double temperature);

}  // namespace haff::campaign
