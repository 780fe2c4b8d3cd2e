// SPDX-License-Identifier: GPL-3.0-or-later

// The cooling gas of rough spheres or disks without correlations: temperatures of translation and
// rotation.
//
//   T      (m/d) <v^2>, of translation          e, beta  normal and tangential restitution
//   R      (I/k) <omega^2>, of rotation about   q        4 I / (m sigma^2): 2/5 of solid spheres,
//          k = d (d-1)/2 axes                            1/2 of solid disks
//   theta  R / T
//
// With Gaussian velocities and spins, per collision suffered by a particle,
//   d ln T/dtau = -(2 (d-1)/d) (A - B theta),   d ln R/dtau = -(2 (d-1)/k) (C - B/theta),
//   A = (1 - e^2)/(2 (d-1)) + eta (1 - eta),   B = eta^2/q,   C = (eta/q) (1 - eta/q),
//   eta = q (1 + beta) / (2 (1 + q)),
// and at the fixed point of theta both decay at the same rate: with r = d/k,
// theta* = h + sqrt(r + h^2), h = (A - r C)/(2 B).
//
// M. Huthmann and A. Zippelius, Phys. Rev. E 56, R6275 (1997), cond-mat/9708093. Deviations from
// Gaussian velocities change theta* little: A. Santos, G. M. Kremer and M. dos Santos, Phys. Fluids
// 23, 030604 (2011), arXiv:1009.6180, who write for spheres
//   h = (1+q)^2 / (2 q (1+beta)^2) [1 - e^2 - (1 - beta^2)(1 - q)/(1 + q)].
// All rates are in proportion to the collision rate, so neither density nor T enters on the clock
// tau.
#pragma once

namespace haff::analysis {

struct Roughness {
  double beta = 1;
  double q = 0.4;
  int d = 3;
};

// theta*, infinite for smooth particles (beta = -1).
double rough_temperature_ratio(double e, const Roughness& roughness);

struct RoughTemperatures {
  double translation = 1;  // T
  double rotation = 0;     // R
};

// Both temperatures a time tau [collisions per particle] after `start`, in the unit of `start`.
RoughTemperatures rough_temperatures(double tau, double e, const Roughness& roughness,
                                     const RoughTemperatures& start);

}  // namespace haff::analysis
