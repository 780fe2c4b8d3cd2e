// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/expected_rate.hpp"

#include <cmath>

#include "analysis/theory/enskog.hpp"
#include "campaign/state/model.hpp"

namespace haff::campaign {

double expected_collision_rate(const schema::Job& job, double temperature) {
  const auto mixture = mixture_of(job);
  if (!mixture) return analysis::transport(job.n, temperature, job.d).collision_rate;
  // Equal spheres (disks) that fill the same part of the box collide n_alike/n times as often at
  // equal chi.
  const double second = 1 - static_cast<double>(mixture->first) / job.particles;
  const double n_alike = job.n * (1 - second + second * std::pow(mixture->diameter, job.d));
  return engine::relative_rate(*mixture, job.d, job.particles) * job.n / n_alike *
         analysis::transport(n_alike, temperature, job.d).collision_rate;
}

}  // namespace haff::campaign
