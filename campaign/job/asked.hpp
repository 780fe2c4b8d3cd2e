// SPDX-License-Identifier: GPL-3.0-or-later

// What the measurements of one moment share.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/mixture.hpp"
#include "engine/simulation.hpp"
#include "schema/grid/job.hpp"

namespace haff::campaign {

inline bool asks_for(const schema::Job& job, std::string_view observable) {
  return std::find(job.observables.begin(), job.observables.end(), observable) !=
         job.observables.end();
}

// Velocities v of a simple gas, sqrt(m) v of a mixture, whose temperature and moments are then
// those of all particles alike, and Gaussian in equilibrium.
inline std::vector<engine::Vector> weighted_velocities(
    const engine::Simulation& gas, const std::optional<engine::Mixture>& mixture) {
  auto velocities = gas.velocities();
  if (!mixture) return velocities;
  const auto ids = gas.ids();
  for (std::size_t i = 0; i < ids.size(); ++i)
    for (double& v : velocities[i]) v *= std::sqrt(mixture->mass_of(ids[i]));
  return velocities;
}

}  // namespace haff::campaign
