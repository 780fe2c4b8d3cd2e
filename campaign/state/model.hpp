// SPDX-License-Identifier: GPL-3.0-or-later

// From a job to the model the engine runs.
#pragma once

#include <optional>

#include "engine/mixture.hpp"
#include "engine/simulation.hpp"
#include "schema/grid/job.hpp"

namespace haff::campaign {

engine::Model model_of(const schema::Job& job);

// The mixture that the job's gas is, if it is one.
std::optional<engine::Mixture> mixture_of(const schema::Job& job);

// The axes about which particles can turn: spheres about all three, disks about the one across
// their plane.
constexpr int axes_of_rotation(int d) {
  return d == 2 ? 1 : 3;
}

}  // namespace haff::campaign
