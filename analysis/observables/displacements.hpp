// SPDX-License-Identifier: GPL-3.0-or-later

// Self-diffusion: how far particles have moved since a waiting time, and how much of their velocity
// is left.
//
//   MSD      < |r(tau) - r(tau_w)|^2 >, r not wrapped into the box
//   VACF     < v(tau) . v(tau_w) > / sqrt(< v(tau)^2 > < v(tau_w)^2 >): 1 at tau_w; the effect of
//            cooling is divided out
//   D/omega  [MSD(tau) - MSD(tau')] / (2 d (tau - tau')): the coefficient of self-diffusion,
//            D = lim dMSD/dt / (2d), in units of the collision rate omega. In a homogeneous cooling
//            gas D and omega are both proportional to sqrt(T), so that D/omega becomes constant
//            while D falls.
//
// As long as no particle collides, MSD = < v^2 > t^2 exactly. Elastic gas, Enskog's theory in the
// first Sonine approximation: D/omega = (T/m)/(nu_D omega), nu_D = (2/d) omega; for higher
// approximations see theory/self_diffusion.hpp. Cooling gas: J. J. Brey, M. J. Ruiz-Montero, D.
// Cubero and R. Garcia-Rojo, Phys. Fluids 12, 876 (2000).
#pragma once

#include <span>

#include "analysis/observables/mesh.hpp"

namespace haff::analysis {

// Both arrays are of the same particles in the same order. The standard error of one state is MSD
// sqrt(2/(d N)), and for the VACF at most 1/sqrt(d N). Both functions throw std::invalid_argument
// if there are no particles or if the lengths differ.
double mean_square_displacement(std::span<const Vector> now, std::span<const Vector> before);

// Independent of the scale of either array. 0 if a gas is at rest.
double velocity_autocorrelation(std::span<const Vector> now, std::span<const Vector> before);

}  // namespace haff::analysis
