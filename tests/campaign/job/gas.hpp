// SPDX-License-Identifier: GPL-3.0-or-later

// A small gas for the tests of measurements, and the job that it belongs to.
#pragma once

#include <cstdint>

#include "campaign/state/model.hpp"
#include "engine/initial.hpp"
#include "engine/simulation.hpp"
#include "schema/grid/job.hpp"

namespace haff::campaign {

inline schema::Job job(double e, std::uint32_t particles = 1000) {
  schema::Job job;
  job.e = e;
  job.n = 0.4;
  job.particles = particles;
  job.seed = 1;
  job.observables = {"laguerre", "temperature"};
  return job;
}

// The gas at its start, with the effects of the job.
inline engine::Simulation gas(const schema::Job& job) {
  const engine::Model model = model_of(job);
  return engine::Simulation(
      model, engine::initial_state(job.n, job.particles, job.seed, job.d, model.effects));
}

}  // namespace haff::campaign
