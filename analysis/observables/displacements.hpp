// SPDX-License-Identifier: GPL-3.0-or-later

// Self-diffusion: how far particles have come since a waiting time, and how much of their
// velocities is left.
//
//   MSD      < |r(tau) - r(tau_w)|^2 >, r not wrapped into the box
//   VACF     < v(tau) . v(tau_w) > / sqrt(< v(tau)^2 > < v(tau_w)^2 >): 1 at tau_w, cooling taken
//   out D/omega  [MSD(tau) - MSD(tau')] / (2 d (tau - tau')): the coefficient of self-diffusion, D
//   = lim
//            dMSD/dt / (2d), in units of the collision rate omega. In a homogeneous cooling gas D
//            and omega both go with sqrt(T), and D/omega settles while D falls.
//
// As long as no particle collides, MSD = < v^2 > t^2 exactly. Elastic gas, Enskog's theory in the
// first Sonine approximation: D/omega = (T/m)/(nu_D omega), nu_D = (2/d) omega:
// theory/self_diffusion.hpp, which knows higher approximations, too. A cooling gas: J. J. Brey, M.
// J. Ruiz-Montero, D. Cubero and R. Garcia-Rojo, Phys. Fluids 12, 876 (2000).
#pragma once

#include <span>

#include "analysis/observables/mesh.hpp"

namespace haff::analysis {

// Of the same particles in the same order. Standard error of one state: MSD sqrt(2/(d N)), of the
// VACF at most 1/sqrt(d N). Each throws std::invalid_argument for none, or arrays of different
// lengths.
double mean_square_displacement(std::span<const Vector> now, std::span<const Vector> before);

// Nothing changes if either array is scaled. 0 if a gas is at rest.
double velocity_autocorrelation(std::span<const Vector> now, std::span<const Vector> before);

}  // namespace haff::analysis
