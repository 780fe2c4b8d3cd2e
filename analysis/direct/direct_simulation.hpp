// SPDX-License-Identifier: GPL-3.0-or-later

// The Enskog-Boltzmann equation of the homogeneous gas, solved by direct simulation: particles
// without positions, whose velocities collide pair by pair at random.
//
//   rate of a pair   chi n sigma^(d-1) / N  int dn Theta(v.n) v.n,   v = v_1 - v_2
//                    = chi n sigma^(d-1) c_d |v| / N,   c_3 = pi, c_2 = 2
//   collision        v_1 -= (1+e)/2 (v.n) n,  v_2 += the same,  n with density ~ Theta(v.n) v.n
//
// G. A. Bird, Molecular Gas Dynamics and the Direct Simulation of Gas Flows (1994), sec. 11.1:
// pairs are tried at the rate of a largest speed and accepted with the probability |v| over that
// speed. J. J. Brey, M. J. Ruiz-Montero and D. Cubero, Phys. Rev. E 54, 3664 (1996), applied this
// to the cooling gas.
//
// There is no structure and there are no correlations of velocities, so the result is that of the
// theory itself, including all orders of a_l, while enskog_boltzmann.hpp is of first order in a_2.
// On the clock tau, density and collision rate do not enter at constant e; chi sets the unit of
// time where a restitution law or a thermostat has one. Shuffling the velocities would change
// nothing here.
//
// Errors: statistical, given with each value, and of order 1/N: a_2 of a Gaussian gas is -2/(3N) in
// 3-d at given energy.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "analysis/direct/restitution.hpp"
#include "analysis/observables/moments.hpp"
#include "analysis/statistics/statistics.hpp"

namespace haff::analysis {

struct HomogeneousGas {
  Restitution law = ConstantRestitution{};
  int d = 3;
  double n = 0.4;      // sets the unit of time through chi(n) n [sigma^-d]
  double heating = 0;  // energy per particle and unit of time of a thermostat's white noise
                       // [E(0)/(sigma sqrt(m/E(0)))]
};

struct SimulationSize {
  std::uint32_t particles = 100'000;
  std::uint32_t realizations = 16;  // at least 2, for the error
  std::uint64_t seed = 1;
};

// One realization at one tau.
struct DirectSample {
  double time = 0;         // [sigma sqrt(m/E(0))]
  double temperature = 0;  // [E(0)]
  LaguerreCoefficients laguerre{};
  double gamma_ratio = 1;  // energy loss per collision over that of a Gaussian gas of this T and
                           // constant e: gamma/gamma_0; NaN for a law without a nominal e
  double rate_ratio = 1;   // omega/omega_0 at this T
};

// Samples of one realization that starts from a Gaussian with E(0) = 1, at tau that do not
// decrease. `stream` tells realizations of one seed apart. Throws std::invalid_argument for a bad
// gas, for fewer than two particles, and for tau that are negative or out of order; throws
// std::domain_error where the law does.
std::vector<DirectSample> direct_realization(const HomogeneousGas& gas, std::span<const double> tau,
                                             std::uint32_t particles, std::uint64_t seed,
                                             std::uint64_t stream);

// All realizations, each with random numbers from a stream of its own.
using DirectRealizations = std::vector<std::vector<DirectSample>>;
DirectRealizations direct_realizations(const HomogeneousGas& gas, std::span<const double> tau,
                                       const SimulationSize& size = {});

// Means over realizations with their standard errors.
struct DirectPoint {
  Estimate time, temperature;
  std::array<Estimate, highest_laguerre + 1> laguerre{};
  Estimate gamma_ratio, rate_ratio;
};

// One point for each tau.
std::vector<DirectPoint> direct_means(const DirectRealizations& realizations);

// The state that no longer changes: each realization is averaged over its samples from `first` on,
// and then the realizations are averaged. Time and temperature do change, so their averages have no
// meaning except in a heated gas.
DirectPoint direct_plateau(const DirectRealizations& realizations, std::size_t first);

}  // namespace haff::analysis
