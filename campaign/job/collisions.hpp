// SPDX-License-Identifier: GPL-3.0-or-later

// The observable collision_statistics: what collisions were like since the profiles before.
#pragma once

#include <vector>

#include "engine/simulation.hpp"
#include "schema/grid/job.hpp"
#include "schema/rows/measured.hpp"

namespace haff::campaign {

// The profiles free_times, impacts and normal_speeds of the job at tau. Takes the counts of the
// gas; none of a gas that does not count, at a tau without profiles, or before the first collision.
std::vector<schema::Profile> collision_statistics(engine::Simulation& gas, const schema::Job& job,
                                                  double tau);

}  // namespace haff::campaign
