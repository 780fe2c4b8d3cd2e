// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/collisions.hpp"

#include <utility>

#include "analysis/observables/collision_statistics.hpp"
#include "campaign/job/timetable.hpp"

namespace haff::campaign {

std::vector<schema::Profile> collision_statistics(engine::Simulation& gas, const schema::Job& job,
                                                  double tau) {
  if (!has_profiles(job, tau)) return {};
  const auto counts = gas.take_collision_counts();
  if (!counts) return {};
  std::vector<schema::Profile> profiles;
  const auto add = [&](const char* name, analysis::Density density) {
    if (density.x.empty()) return;
    profiles.push_back({name, tau, std::move(density.x), std::move(density.value)});
  };
  using Counts = engine::CollisionCounts;
  add("free_times", analysis::density_of_free_times(counts->free_time, Counts::free_time_resolution,
                                                    job.particles));
  add("impacts", analysis::density(counts->impact, 1.0 / Counts::bins_of_impact));
  add("normal_speeds",
      analysis::density_with_rest(counts->normal_speed, 1.0 / Counts::normal_speed_resolution));
  return profiles;
}

}  // namespace haff::campaign
