// SPDX-License-Identifier: GPL-3.0-or-later

// Energy decay with velocity correlations, from Haff's law to the end of the homogeneous stage:
//
//   dE/dtau = -2 gamma_0 f (E - (m/2) Tr G^+(0, tau)),   E(0) = 1
//   gamma/gamma_0 = f (1 - (m/2) Tr G^+ / E)
//
// R. Kawahara and H. Nakanishi, cond-mat/0309130, with f = 1, which assumes that velocities in a
// small volume are Gaussian. They are not quite, and in a dilute gas most of the difference between
// gamma and gamma_0 comes from this. f = gamma/gamma_0 of Enskog-Boltzmann theory at this tau
// (enskog_boltzmann.hpp) takes it into account. The only free number of the theory, b, sets the
// cutoff of Tr G^+ (see correlations.hpp).
//
// Solved on s = 2 gamma_0 tau for F = E / E_Haff, which does not underflow: with
// T_Haff = (2/d) E_Haff,
//   dF/ds = (1 - f) F + f (strength / d) I,   dI/ds = trace_density(s),   F(0) = 1, I(0) = 0.
#pragma once

#include <span>
#include <vector>

#include "analysis/theory/correlations.hpp"
#include "analysis/theory/gas.hpp"

namespace haff::analysis {

// The choice of f: 1, or gamma/gamma_0 of Enskog-Boltzmann theory.
enum class Velocities { gaussian, enskog_boltzmann };

struct EnergyPoint {
  double tau = 0;
  double energy = 1;       // E(tau) [E(0)]
  double haff = 1;         // E_Haff(tau) [E(0)]
  double gamma_ratio = 1;  // gamma(tau) / gamma_0
};

// The solution at increasing tau >= 0. Relative error below 1e-9. Throws std::invalid_argument
// at e = 1 and for tau that are negative or out of order.
std::vector<EnergyPoint> energy_equation(const Gas& gas, std::span<const double> tau,
                                         double b = cutoff_b,
                                         Velocities velocities = Velocities::gaussian);

// tau_c of the theory, where E = 2 E_Haff. Errors as above.
double energy_equation_tau_c(const Gas& gas, double b = cutoff_b,
                             Velocities velocities = Velocities::gaussian);

// The cutoff number b that fits a measured E(tau) best. Residuals of ln E are weighted by
// energy_error / energy (equally if energy_error is empty).
struct CutoffFit {
  double b = 0;
  // From the curvature of chi^2, scaled by the scatter if no errors are given. Samples of one
  // series are correlated, so this is a lower bound: the spread of fits to independent realizations
  // is the true error.
  double standard_error = 0;
  double chi_squared_per_sample = 0;  // over N - 1 degrees of freedom; NaN without errors
};
// Throws std::invalid_argument for lengths that differ or fewer than two samples with tau > 0,
// std::runtime_error if GSL's least squares do not converge.
CutoffFit fit_cutoff(const Gas& gas, std::span<const double> tau, std::span<const double> energy,
                     std::span<const double> energy_error = {},
                     Velocities velocities = Velocities::gaussian);

}  // namespace haff::analysis
