// SPDX-License-Identifier: GPL-3.0-or-later

// Statistics of collisions in an elastic gas, if the velocities of two particles that are about to
// collide are independent of each other (molecular chaos) and Maxwellian.
//
//   c          v / v_0, v_0^2 = 2 T / m; phi(c) = pi^(-d/2) exp(-c^2)
//   r(c)       collision rate of a particle of speed c over the mean one, omega:
//              <|c - c'|>_c' / <|c - c'|>,
//              3-d: [exp(-c^2) + (2c + 1/c) (sqrt(pi)/2) erf(c)] / sqrt(8)
//              2-d: exp(-c^2/2) [(1 + c^2) I_0(c^2/2) + c^2 I_1(c^2/2)] / sqrt(2)
//   p(u)       density of free times u = omega t. A particle of speed c is hit at random with the
//              rate r(c) omega, and as many flights begin with c as end: phi(c) r(c). So
//              p(u) = int d^dc phi(c) r(c)^2 exp(-r(c) u): not an exponential, but a mixture of
//              exponentials; p(0) = <r^2> > 1, and its mean is 1.
//   b          impact parameter over sigma: b^(d-1) is uniform on [0, 1], since collisions are the
//              more frequent the larger the cross-section. This needs only isotropy and chaos, not
//              a Maxwellian.
//   w          normal speed times sqrt(mu/T): density w exp(-w^2/2), any d
//
// P. Visco, F. van Wijland and E. Trizac, J. Phys. Chem. B 112, 5412 (2008), arXiv:0801.2728, and
// Phys. Rev. E 77, 041117 (2008), arXiv:0803.1291, derive p(u) of the dilute gas and find it in
// simulations. In a dense gas a flight is not independent of those before it: for an elastic gas at
// n = 0.4 the density below u = 0.1 was measured as 0.955; this theory gives 0.988. The densities
// of b and w are exact at any density, in equilibrium.
#pragma once

namespace haff::analysis {

// r(c), c >= 0.
double relative_collision_rate(double c, int d = 3);

// p(u), u >= 0, to a relative 1e-8.
double free_time_density(double u, int d = 3);

double normal_speed_density(double w);

}  // namespace haff::analysis
