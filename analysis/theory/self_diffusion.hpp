// SPDX-License-Identifier: GPL-3.0-or-later

// Self-diffusion of elastic hard spheres and disks in Enskog's theory.
//
//   nu_D        rate at which a particle loses its velocity: (2/d) omega_0, exact as t -> 0, as a
//               collision takes (2/d) of it on average
//   D           (T/m) / nu_D in the first Sonine approximation
//   omega_0     collision rate (enskog.hpp); D and omega_0 both go with sqrt(T)
//   D/omega_0   d T / (2 m omega_0^2), free of temperature
//
// All approximations together give 1.019 times the first for spheres: S. Chapman and T. G. Cowling,
// The Mathematical Theory of Non-uniform Gases (1970), sec. 14.2 (the second gives 60/59). For
// disks the first is taken, which is too small by 2 to 3 %. Correlated collisions, which Enskog's
// theory leaves out, raise D of spheres by some 15 % at n = 0.4 and lower it beyond n = 0.8: B. J.
// Alder, D. M. Gass and T. E. Wainwright, J. Chem. Phys. 53, 3813 (1970).
#pragma once

namespace haff::analysis {

// D/omega_0 [sigma^2]. Throws std::invalid_argument as enskog.hpp does.
double self_diffusion_per_collision(double n, int d = 3);

// The velocity autocorrelation function tau collisions later, exp(-2 tau/d): exact to first order
// in tau, and for spheres within 2 % of Enskog's where it is above 0.1.
double enskog_autocorrelation(double tau, int d = 3);

}  // namespace haff::analysis
