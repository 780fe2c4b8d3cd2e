// SPDX-License-Identifier: GPL-3.0-or-later

// Statistics of collisions as profiles of a job: only when they are listed, and as theory says in a
// dilute elastic gas.
#include "campaign/job/collisions.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "analysis/theory/collision_statistics.hpp"
#include "campaign/job/gas.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

schema::Job observed_job(double e, std::uint32_t particles) {
  schema::Job physics = job(e, particles);
  physics.observables = {"collision_statistics", "temperature"};
  physics.profiles_every = 10;
  return physics;
}

void run_to(engine::Simulation& gas, const schema::Job& job, double tau) {
  gas.run_to(engine::collisions_at(tau, job.particles));
}

}  // namespace

TEST_CASE("collisions: profiles at their times, of the collisions since the previous profiles") {
  const auto physics = observed_job(0.8, 500);
  auto gas = campaign::gas(physics);
  CHECK(collision_statistics(gas, physics, 0).empty());  // no collision has happened yet
  run_to(gas, physics, 5);
  CHECK(collision_statistics(gas, physics, 5).empty());
  run_to(gas, physics, 10);
  const auto first = collision_statistics(gas, physics, 10);
  REQUIRE(first.size() == 3);
  CHECK(first[0].name == "free_times");
  CHECK(first[1].name == "impacts");
  CHECK(first[2].name == "normal_speeds");
  for (const schema::Profile& profile : first) {
    CHECK(profile.tau == 10);
    double sum = 0;
    for (std::size_t i = 1; i < profile.x.size(); ++i)
      sum += (profile.x[i] - profile.x[i - 1]) * (profile.value[i] + profile.value[i - 1]) / 2;
    CHECK(sum == doctest::Approx(1).epsilon(0.05));  // except for the ends
  }
  CHECK(collision_statistics(gas, physics, 10).empty());  // they have been taken
}

TEST_CASE("collisions: a job that does not list them does not count them") {
  auto physics = job(0.8, 500);
  physics.profiles_every = 10;
  auto gas = campaign::gas(physics);
  run_to(gas, physics, 10);
  CHECK(collision_statistics(gas, physics, 10).empty());
}

TEST_CASE("collisions: free times of a dilute elastic gas are not exponential") {
  // 2 10^5 flights. Chi^2 over 50 bins, up to u = 5, is within 1 +- 5 sqrt(2/50): a false alarm in
  // one of 10^5 seeds, if flights are independent. The same test refuses an exponential.
  for (const int d : {2, 3}) {
    CAPTURE(d);
    auto physics = observed_job(1, 2000);
    physics.d = d;
    physics.n = d == 3 ? 0.005 : 0.01;
    auto gas = campaign::gas(physics);
    run_to(gas, physics, 20);
    collision_statistics(gas, physics, 20);
    run_to(gas, physics, 120);
    const auto profiles = collision_statistics(gas, physics, 120);
    const schema::Profile& free_times = profiles.front();
    double of_theory = 0, of_exponential = 0;
    constexpr double flights = 2e5, width = 0.1;
    for (std::size_t i = 0; i < 50; ++i) {
      const double u = free_times.x[i];
      const auto add = [&](double& chi2, double density) {
        chi2 += std::pow(free_times.value[i] - density, 2) * flights * width / density / 50;
      };
      add(of_theory, analysis::free_time_density(u, d));
      add(of_exponential, std::exp(-u));
    }
    CAPTURE(of_theory);
    const double allowed = 5 * std::sqrt(2.0 / 50);
    CHECK(std::abs(of_theory - 1) < allowed);
    CHECK(of_exponential - 1 > allowed);
  }
}
