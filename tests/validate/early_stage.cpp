// SPDX-License-Identifier: GPL-3.0-or-later

// The early stage of cooling against R. Kawahara and H. Nakanishi, cond-mat/0309130: Laguerre
// coefficients, decay and the energy equation at n = 0.40.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "analysis/observables/moments.hpp"
#include "analysis/theory/energy_equation.hpp"
#include "analysis/theory/enskog_boltzmann.hpp"
#include "engine/initial.hpp"
#include "engine/simulation.hpp"

using namespace haff;

namespace {

constexpr std::uint32_t particles = 108'000;
constexpr double n = 0.4;

engine::State equilibrated() {
  engine::Simulation melting({.restitution = 1}, engine::initial_state(n, particles, 1));
  melting.run_to(engine::collisions_at(50, particles));
  return engine::restarted(melting.state());
}

analysis::Moments measured(const engine::Simulation& gas) {
  analysis::Moments moments = analysis::moments(gas.velocities());
  moments.temperature = std::ldexp(moments.temperature, -2 * gas.exponent());
  return moments;
}

}  // namespace

TEST_CASE("equilibrium is Gaussian") {
  const engine::State state = equilibrated();
  const auto laguerre = analysis::moments(state.velocity).laguerre;
  CHECK(laguerre[0] == doctest::Approx(1).epsilon(1e-12));
  CHECK(std::abs(laguerre[1]) < 1e-12);
  // Four standard errors are a false alarm once in 5000 seeds, and the seed is fixed.
  for (int l = 2; l <= 4; ++l)
    CHECK(std::abs(laguerre[static_cast<std::size_t>(l)]) <
          4 * analysis::laguerre_noise(l, particles));
}

TEST_CASE("temperature decays as in an independent simulation and in the energy equation") {
  // ln T/T0 of one realization of the same size by another engine. Two realizations of this size
  // differ by about 0.005 there, so 0.02 is some three standard errors of a difference.
  constexpr double tolerance = 0.02;
  engine::Simulation gas({.restitution = 0.8}, equilibrated());
  const analysis::Gas theory{.e = 0.8, .n = n};
  for (const auto& [tau, expected] : {std::pair{10.0, -1.1734}, {20.0, -2.3190}}) {
    gas.run_to(engine::collisions_at(tau, particles));
    const double log_temperature = std::log(measured(gas).temperature * 1.5);
    CHECK(std::abs(log_temperature - expected) < tolerance);
    const std::vector<double> at{tau};
    const double energy = analysis::energy_equation(theory, at).front().energy;
    CHECK(std::abs(log_temperature - std::log(energy)) < tolerance);
  }
}

TEST_CASE("a2 follows the Enskog-Boltzmann solution at short times") {
  // Until tau = 3 correlations are negligible; five standard errors of one sample are allowed.
  const double e = 0.9;
  engine::Simulation gas({.restitution = e}, equilibrated());
  const double before = measured(gas).laguerre[2];
  for (const double tau : {0.5, 1.0, 2.0, 3.0}) {
    CAPTURE(tau);
    gas.run_to(engine::collisions_at(tau, particles));
    const double a2 = measured(gas).laguerre[2];
    CHECK(std::abs(a2 - analysis::boltzmann_a2(tau, e)) <
          5 * analysis::laguerre_noise(2, particles) + std::abs(before));
  }
}
