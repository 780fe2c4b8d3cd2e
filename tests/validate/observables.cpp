// SPDX-License-Identifier: GPL-3.0-or-later

// Observables of an elastic gas in equilibrium, compared with exact results. Some five minutes of
// CPU time.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "analysis/observables/collision_statistics.hpp"
#include "analysis/observables/pair_distribution.hpp"
#include "analysis/statistics/statistics.hpp"
#include "analysis/theory/collision_statistics.hpp"
#include "engine/initial.hpp"
#include "engine/simulation.hpp"

using namespace haff;

namespace {

struct Fluid {
  double n;
  double z;      // p/(n T), known to 2e-5: elastic_fluid.cpp
  double every;  // tau between states, in which a pair leaves the range of contact
  int states;
};

// chi = g(sigma+) of one gas, from pairs near contact in many states.
void check_contact_value(const Fluid& fluid) {
  CAPTURE(fluid.n);
  constexpr std::uint32_t particles = 32'000;  // g(r) is lower by 1/N, and Z - 1 higher by 0.4/N
  const double known = 3 * (fluid.z - 1) / (2 * std::numbers::pi * fluid.n);
  engine::Simulation gas({.restitution = 1}, engine::initial_state(fluid.n, particles, 1));
  const double box = engine::box_side(fluid.n, particles, 3);
  constexpr double reach = 1 + analysis::contact_range;  // more would take five times as long
  std::vector<double> chi;
  for (int k = 0; k < fluid.states; ++k) {
    gas.run_to(engine::collisions_at(30 + k * fluid.every, particles));
    chi.push_back(analysis::pair_distribution(gas.positions(), box, 3, 1, reach).g.front());
  }
  const auto measured = analysis::block_estimate(chi).estimate;
  MESSAGE("n = " << fluid.n << ": chi = " << measured.mean << " +- " << measured.standard_error
                 << ", of the equation of state " << known);
  // The claim is 1e-3, and a standard error is a third of it: a false alarm in one of 370 seeds,
  // and in one of 100 where the extrapolation has its largest bias, 1.2e-4 at n = 0.4.
  constexpr double claimed = 1e-3;
  CHECK(measured.standard_error < claimed / 3 * known);
  CHECK(std::abs(measured.mean - known) < claimed * known);
}

engine::CollisionCounts counted(double n, int d, std::uint32_t particles, double tau) {
  engine::Simulation gas({.restitution = 1, .counts_collisions = true},
                         engine::initial_state(n, particles, 1, d));
  gas.run_to(engine::collisions_at(50, particles));
  gas.take_collision_counts();
  gas.run_to(engine::collisions_at(50 + tau, particles));
  return *gas.take_collision_counts();
}

// The mean of (measured - known)^2 over its variance, in bins that hold at least 100: 1 +-
// sqrt(2/bins).
struct Fit {
  double chi2 = 0;
  int bins = 0;

  void add(double measured, double known, double all, double width) {
    const double expected = known * all * width;
    if (expected < 100) return;
    chi2 += std::pow((measured - known) * all * width, 2) / expected;
    ++bins;
  }
  double excess() const { return std::abs(chi2 / bins - 1) / std::sqrt(2.0 / bins); }
};

}  // namespace

TEST_CASE("observables: the contact value of g(r) is that of the equation of state, to 1e-3") {
  check_contact_value({.n = 0.1, .z = 1.239720, .every = 0.3, .states = 16'000});
  check_contact_value({.n = 0.4, .z = 2.52161, .every = 0.6, .states = 5'000});
}

TEST_CASE("observables: impact parameters of an elastic gas are those of molecular chaos") {
  // 4 10^6 collisions: a bin is known to 0.22 %. Five standard deviations of chi^2 are allowed.
  for (const int d : {2, 3})
    for (const double n : {0.05, 0.4}) {
      CAPTURE(d);
      CAPTURE(n);
      constexpr double collisions = 4e6;
      const auto counts = counted(n, d, 4000, 2000);
      constexpr double width = 1.0 / engine::CollisionCounts::bins_of_impact;
      Fit fit;
      for (const double value : analysis::density(counts.impact, width).value)
        fit.add(value, 1, collisions, width);
      CHECK(fit.excess() < 5);
    }
}

TEST_CASE("observables: free times of a dilute elastic gas are those of the Boltzmann equation") {
  // 8 10^6 flights. Collisions with an earlier partner are rare at these densities.
  for (const int d : {2, 3}) {
    CAPTURE(d);
    constexpr double flights = 8e6;
    const auto counts = counted(d == 3 ? 0.002 : 0.001, d, 4000, 2000);
    const auto density = analysis::density_of_free_times(counts.free_time, 10, 4000);
    Fit fit, exponential;
    for (std::size_t i = 0; i < density.x.size(); ++i) {
      fit.add(density.value[i], analysis::free_time_density(density.x[i], d), flights, 0.1);
      exponential.add(density.value[i], std::exp(-density.x[i]), flights, 0.1);
    }
    MESSAGE("d = " << d << ": p(0) = " << density.value.front() << ", known "
                   << analysis::free_time_density(density.x.front(), d) << "; chi^2 per bin "
                   << fit.chi2 / fit.bins << ", of an exponential "
                   << exponential.chi2 / exponential.bins);
    CHECK(fit.excess() < 5);
    CHECK(exponential.chi2 / exponential.bins > 50);
  }
}
