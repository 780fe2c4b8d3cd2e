// The cooling binary mixture without correlations: the ratio of the species' temperatures.
//
//   x_i, sigma_i, m_i   fraction, diameter and mass of species i (sigma_1 = m_1 = 1)
//   T_i                 (m_i/3) <v^2> over species i,   v_i^2 = 2 T_i / m_i
//   sigma_ij            (sigma_i + sigma_j)/2,   mu_ji = m_j / (m_i + m_j)
//   chi_ij              pair correlation at contact, of T. Boublik, J. Chem. Phys. 53, 471 (1970)
//   and
//                       G. A. Mansoori et al., J. Chem. Phys. 54, 1523 (1971): with the packing
//                       fraction phi, M_s = sum x_i sigma_i^s and y = sigma_i sigma_j M_2 /
//                       (sigma_ij M_3),
//                       1/(1-phi) + 3 phi y / (2 (1-phi)^2) + phi^2 y^2 / (2 (1-phi)^3)
//
// With Gaussian velocities of either species the energy of species i falls at the rate
//   zeta_i = -d ln T_i/dt = (8 sqrt(pi)/3) sum_j n x_j chi_ij sigma_ij^2 mu_ji (1+e)
//            sqrt(v_i^2 + v_j^2) [1 - (mu_ji/2) (1+e) (1 + v_j^2/v_i^2)],
// and in the homogeneous cooling state both fall alike, zeta_1 = zeta_2, which gives T_1/T_2:
// V. Garzo and J. Dufty, Phys. Rev. E 60, 5706 (1999); compared with simulations by S. R. Dahl, C.
// M. Hrenya, V. Garzo and J. W. Dufty, Phys. Rev. E 66, 041301 (2002), cond-mat/0205413, who find
// good agreement at low density and weak dissipation. Their correction for velocities that are not
// quite Gaussian is left out.
#pragma once

namespace haff::analysis {

struct BinaryMixture {
  double e = 1;
  double n = 0.1;             // number density of all [sigma_1^-3]
  double fraction = 0.5;      // x_2
  double diameter_ratio = 1;  // sigma_2 / sigma_1
  double mass_ratio = 1;      // m_2 / m_1
};

// (pi/6) n sum x_i sigma_i^3.
double packing_fraction(const BinaryMixture& gas);

// chi_ij of species i and j (1 or 2). Throws std::invalid_argument unless phi < 1.
double contact_value(const BinaryMixture& gas, int i, int j);

// zeta_i of species i (1 or 2) at these temperatures, in units of sqrt(T/m)/sigma of species 1.
double cooling_rate(const BinaryMixture& gas, int i, double temperature_1, double temperature_2);

// T_1/T_2 in the homogeneous cooling state; 1 for e = 1.
double temperature_ratio(const BinaryMixture& gas);

}  // namespace haff::analysis
