// SPDX-License-Identifier: GPL-3.0-or-later

// The binary mixture of spheres or disks without correlations, cooling or heated: the ratio of the
// temperatures of the two species.
//
//   x_i, sigma_i, m_i   fraction, diameter and mass of species i (sigma_1 = m_1 = 1)
//   T_i                 (m_i/d) <v^2> over species i,   v_i^2 = 2 T_i / m_i
//   sigma_ij            (sigma_i + sigma_j)/2,   mu_ji = m_j / (m_i + m_j)
//   chi_ij              pair correlation at contact, with the packing fraction phi,
//                       M_s = sum x_i sigma_i^s and y = sigma_i sigma_j M_(d-1) / (sigma_ij M_d).
//                       For spheres it is
//                         1/(1-phi) + 3 phi y / (2 (1-phi)^2) + phi^2 y^2 / (2 (1-phi)^3),
//                       T. Boublik, J. Chem. Phys. 53, 471 (1970), G. A. Mansoori et al., J. Chem.
//                       Phys. 54, 1523 (1971), and for disks
//                         1/(1-phi) + 9 phi y / (16 (1-phi)^2),
//                       J. T. Jenkins and F. Mancini, J. Appl. Mech. 54, 27 (1987)
//
// With Gaussian velocities in both species the energy of species i falls at the rate
//   zeta_i = -d ln T_i/dt = c_d sum_j n x_j chi_ij sigma_ij^(d-1) mu_ji (1+e)
//            sqrt(v_i^2 + v_j^2) [1 - (mu_ji/2) (1+e) (1 + v_j^2/v_i^2)],
//   c_3 = 8 sqrt(pi)/3,   c_2 = 2 sqrt(pi),
// In the homogeneous cooling state both energies fall at the same rate, zeta_1 = zeta_2, which
// gives T_1/T_2: V. Garzo and J. Dufty, Phys. Rev. E 60, 5706 (1999); compared with simulations by
// S. R. Dahl, C. M. Hrenya, V. Garzo and J. W. Dufty, Phys. Rev. E 66, 041301 (2002),
// cond-mat/0205413, who find good agreement at low density and weak dissipation. Their correction
// for deviations from Gaussian velocities is left out.
//
// Where all particles feel the same random accelerations, species i gains energy in proportion to
// m_i. The steady state is where zeta_1 T_1/m_1 = zeta_2 T_2/m_2: A. Barrat and E. Trizac, Granular
// Matter 4, 57 (2002), cond-mat/0202297.
#pragma once

namespace haff::analysis {

struct BinaryMixture {
  double e = 1;
  double n = 0.1;             // number density of all particles [sigma_1^-d]
  double fraction = 0.5;      // x_2
  double diameter_ratio = 1;  // sigma_2 / sigma_1
  double mass_ratio = 1;      // m_2 / m_1
  int d = 3;
};

// (pi/6) n sum x_i sigma_i^3; for disks (pi/4) n sum x_i sigma_i^2.
double packing_fraction(const BinaryMixture& gas);

// chi_ij of species i and j (1 or 2). Throws std::invalid_argument unless phi < 1.
double contact_value(const BinaryMixture& gas, int i, int j);

// zeta_i of species i (1 or 2) at these temperatures, in units of sqrt(T/m)/sigma of species 1.
double cooling_rate(const BinaryMixture& gas, int i, double temperature_1, double temperature_2);

// T_1/T_2 in the homogeneous cooling state; 1 for e = 1.
double temperature_ratio(const BinaryMixture& gas);

// T_1/T_2 where noise and collisions balance. For e < 1.
double heated_temperature_ratio(const BinaryMixture& gas);

}  // namespace haff::analysis
