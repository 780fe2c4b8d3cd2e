// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/state/energy.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "engine/initial.hpp"
#include "engine/simulation.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

const schema::Job job{.e = 0.95, .n = 0.4, .particles = 100, .seed = 1};

// A gas at tau = 30, colder than at its start by the factor 2^(-2 exponent).
engine::State cold_state(int exponent) {
  engine::State state = engine::initial_state(job.n, job.particles, 1);
  state.exponent = exponent;
  state.collisions = engine::collisions_at(30, job.particles);
  return state;
}

schema::Sample sample_of(const engine::State& state, double tau) {
  return {.tau = tau, .time = tau, .temperature = total_energy(state, job)};
}

}  // namespace

TEST_CASE("energy: a gas is sound even if its temperature is 0 or has few digits left") {
  // 2^-1022 is the last temperature with all digits, 2^-1074 the last above 0.
  for (int exponent = 500; exponent <= 560; ++exponent) {
    CAPTURE(exponent);
    const engine::State state = cold_state(exponent);
    CHECK_FALSE(energy_contradiction(state, job,
                                     {sample_of(cold_state(exponent - 1), 25), sample_of(state, 30),
                                      sample_of(cold_state(exponent + 1), 35)}));
  }
}

TEST_CASE("energy: a state that is not that of the sample beside it is refused") {
  const engine::State state = cold_state(400);
  for (const int other : {399, 401}) {
    CAPTURE(other);
    CHECK(energy_contradiction(state, job, {sample_of(cold_state(other), 30)}));
  }
  CHECK(energy_contradiction(state, job, {sample_of(cold_state(401), 25)}));
  CHECK(energy_contradiction(state, job, {sample_of(cold_state(399), 35)}));
}
