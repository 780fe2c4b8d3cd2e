// SPDX-License-Identifier: GPL-3.0-or-later

// Self-diffusion of elastic hard spheres and disks: Enskog's theory, and simulations.
//
//   nu_D        rate at which a particle loses its velocity: (2/d) omega_0, exact as t -> 0,
//               since a collision removes 2/d of the velocity on average
//   D           (T/m) / nu_D in the first Sonine approximation
//   omega_0     collision rate (enskog.hpp); D and omega_0 are both proportional to sqrt(T)
//   D/omega_0   d T / (2 m omega_0^2), independent of temperature
//
// For spheres all approximations together give 1.019 times the first: S. Chapman and T. G. Cowling,
// The Mathematical Theory of Non-uniform Gases (1970), sec. 14.2 (the second gives 60/59). For
// disks the first approximation is taken, which is too small by 2 to 3 %.
//
// Enskog's theory leaves out correlated collisions. With them, molecular dynamics of spheres give
//   D = (3/8n) sqrt(T/pi) (1 - n/1.09) (1 + n^2 (0.4 - 0.83 n^2))
// from the dilute gas (without the factor 1.019, which the fit leaves out) to n = 1.08: R. J.
// Speedy, Mol. Phys. 62, 509 (1987). This is more than Enskog's D by 2 % at n = 0.1, 7 % at 0.2,
// 17 % at 0.4 and by 20 %, the maximum, from 0.5 to 0.6; it is less than Enskog's D beyond
// n = 0.78. It is the D of a large gas: in a periodic box of side L, D is smaller by 2.837 T/(6 pi
// eta L) (I.-C. Yeh and G. Hummer, J. Phys. Chem. B 108, 15873 (2004)).
#pragma once

namespace haff::analysis {

// D/omega_0 [sigma^2]. Throws std::invalid_argument as enskog.hpp does.
double self_diffusion_per_collision(double n, int d = 3);

// The same for spheres, from simulations. Throws likewise, and for n above 1.08.
double simulated_self_diffusion_per_collision(double n);

// The velocity autocorrelation function tau collisions later, exp(-2 tau/d): exact to first order
// in tau, and for spheres within 2 % of Enskog's function where that is above 0.1.
double enskog_autocorrelation(double tau, int d = 3);

}  // namespace haff::analysis
