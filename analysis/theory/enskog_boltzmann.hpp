// The cooling gas without correlations: Enskog-Boltzmann theory, to first order in a_2.
//
//   da_2/dtau = A + B a_2
//   A = (e^2 - 1)(2 e^2 - 1) / (d (d+2))
//   B = -(1 + e)(9 + 24 d + 8 e d - 41 e + 30 (1 - e) e^2) / (16 d (d+2))
//   omega/omega_0 = 1 - a_2/16,   gamma/gamma_0 = (1 + 3 a_2/16) / (omega/omega_0)
//
// T. P. C. van Noije and M. H. Ernst, Granular Matter 1, 57 (1998); in this form R. Kawahara and
// H. Nakanishi, cond-mat/0309130. Linear in a_2: good to a few percent of a_2 for e > 0.6.
#pragma once

namespace haff::analysis {

// a_2 a time tau after a Gaussian start.
double boltzmann_a2(double tau, double e, int d = 3);

// Its plateau -A/B, the homogeneous cooling state.
double boltzmann_a2_plateau(double e, int d = 3);

// a_2 of the state that Gaussian white noise keeps warm.
double heated_a2(double e, int d = 3);

// omega/omega_0 and gamma/gamma_0 of a gas with this a_2.
double boltzmann_rate_ratio(double a2);
double boltzmann_gamma_ratio(double a2);

}  // namespace haff::analysis
