// SPDX-License-Identifier: GPL-3.0-or-later

// Enskog's transport theory of elastic hard spheres and disks, and the length scales of the
// velocity correlations of the cooling gas that follow from it.
//
//   phi            packing fraction, pi n / 6 (spheres), pi n / 4 (disks)
//   chi            pair correlation at contact: N. F. Carnahan and K. E. Starling, J. Chem. Phys.
//                  51, 635 (1969); disks: D. Henderson, Mol. Phys. 30, 971 (1975)
//   omega_0        collision frequency Omega_d chi n sigma^(d-1) v_0 / sqrt(2 pi)
//   eta, zeta      shear and bulk viscosity, nu = eta / (m n)
//   kappa          heat conductivity (Boltzmann's constant is one)
//   z              p / (n T) = 1 + 2^(d-1) phi chi
//   g              d ln omega_0 / d ln n = 1 + d ln chi / d ln n
//   l_0            v_0 / omega_0, with v_0^2 = 2 T / m
//   xi_perp^2      nu / (omega_0 gamma_0)
//   xi_l^2         nu_l / (omega_0 gamma_0),  nu_l = (2 (d-1) eta / d + zeta) / (m n)
//   xi_T^2         2 kappa / (d n omega_0 gamma_0)
//   xi_par^2       xi_l^2 + l_0^2 / (2 gamma_0^2) (z - g + z^2 / d)
//
// Spheres: J. O. Hirschfelder, C. F. Curtiss and R. B. Bird, Molecular Theory of Gases and
// Liquids (1954), sec. 9.3. Disks: D. M. Gass, J. Chem. Phys. 54, 1898 (1971). Lengths: T. P. C.
// van Noije and M. H. Ernst, cond-mat/9907012; R. Kawahara and H. Nakanishi, cond-mat/0309130.
#pragma once

#include "analysis/theory/gas.hpp"

namespace haff::analysis {

double packing_fraction(double n, int d = 3);

// chi. Throws std::invalid_argument unless 0 <= phi < 1 and d is 2 or 3 (as do all below).
double contact_value(double n, int d = 3);

struct EquationOfState {
  double z = 1;          // p / (n T)
  double g = 1;          // d ln omega_0 / d ln n
  double stiffness = 1;  // (1/T) dp/dn = d(n z)/dn
};
EquationOfState equation_of_state(double n, int d = 3);

// Transport coefficients at a temperature [energy]; all are proportional to sqrt(T).
// The numerical prefactors are those of the first Sonine approximation corrected to higher
// order; they are known to four digits.
struct Transport {
  double collision_rate = 0;  // omega_0 [1/time]
  double viscosity = 0;       // eta [mass length^(2-d) / time]
  double bulk_viscosity = 0;  // zeta, likewise; exact within Enskog theory
  double conductivity = 0;    // kappa [length^(2-d) / time]
};
Transport transport(double n, double temperature, int d = 3);

// The lengths of the linear theory [sigma], independent of temperature. Throws
// std::invalid_argument at e = 1, where gamma_0 = 0 and they are infinite.
struct Lengths {
  double free_path = 0;     // l_0
  double transverse = 0;    // xi_perp
  double sound = 0;         // xi_l
  double heat = 0;          // xi_T
  double longitudinal = 0;  // xi_par
};
Lengths lengths(const Gas& gas);

}  // namespace haff::analysis
