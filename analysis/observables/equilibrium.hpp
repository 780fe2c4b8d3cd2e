// SPDX-License-Identifier: GPL-3.0-or-later

// Whether a gas of few particles has the velocities of elastic equilibrium.
//
//   D = d (N-1)         dimensions in which the velocities of N particles of given energy and zero
//                       total momentum are uniform on a sphere
//   <c^2k> = Gaussian / prod_{j<k} (1 + 2j/D)     moments fall short of their Gaussian values
//   a_l                 Laguerre (Sonine) coefficients, moments.hpp; at equilibrium a_2 = -2/(D+2)
#pragma once

#include <array>
#include <optional>

namespace haff::analysis {

// Mean a_l of N particles at equilibrium with fixed energy and zero total momentum.
double equilibrium_laguerre(int l, double particles, int d = 3);

// Whether a_2, a_3 and a_4 are each within 4 standard errors (laguerre_noise) of their mean at
// equilibrium. False if one does not exist (a gas at rest). A gas at equilibrium fails this check
// once in some 10^4 times, since a_4 has heavy tails at small N.
bool is_equilibrated(const std::array<std::optional<double>, 3>& a2_to_a4, double particles,
                     int d = 3);

}  // namespace haff::analysis
