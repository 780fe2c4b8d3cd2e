// SPDX-License-Identifier: GPL-3.0-or-later

// The cooling gas without correlations: Enskog-Boltzmann theory, to first order in a_2.
//
//   da_2/dtau = A + B a_2
//   A = (e^2 - 1)(2 e^2 - 1) / (d (d+2))
//   B = -(1 + e)(9 + 24 d + 8 e d - 41 e + 30 (1 - e) e^2) / (16 d (d+2))
//   omega/omega_0 = 1 - a_2/16,   gamma/gamma_0 = (1 + 3 a_2/16) / (omega/omega_0)
//
// T. P. C. van Noije and M. H. Ernst, Granular Matter 1, 57 (1998); in this form in R. Kawahara and
// H. Nakanishi, cond-mat/0309130.
//
// The exact a_2 of the equation differs: at its fixed point a_3 is a third of a_2 and pushes a_2
// further. -A/B falls 6 to 12 % short of it between e = 0.95 and 0.80 in 3-d, and has the wrong
// sign at e = 0.7, where A has just changed sign. analysis/direct solves the equation to all
// orders.
#pragma once

namespace haff::analysis {

// a_2 a time tau after a Gaussian start.
double boltzmann_a2(double tau, double e, int d = 3);

// Its fixed point -A/B: the homogeneous cooling state to first order in a_2.
double boltzmann_a2_plateau(double e, int d = 3);

// da_l/dtau of a Gaussian gas for l = 2 and 3: exact. For two particles that collide, h =
// (v_1 - v_2)/2 and V = (v_1 + v_2)/2 are independent Gaussians of variance T/(2m) per component,
// except for the component of h along the normal, whose square is exponential with mean T/m and
// shrinks by e^2. The sums of v^4 and v^6 over both particles follow from this. da_2/dtau is A.
struct InitialSlopes {
  double a2 = 0;
  double a3 = 0;
};
InitialSlopes boltzmann_initial_slopes(double e, int d = 3);

// a_2 of the steady state of a gas heated by Gaussian white noise.
double heated_a2(double e, int d = 3);

// omega/omega_0 and gamma/gamma_0 of a gas with this a_2.
double boltzmann_rate_ratio(double a2);
double boltzmann_gamma_ratio(double a2);

}  // namespace haff::analysis
