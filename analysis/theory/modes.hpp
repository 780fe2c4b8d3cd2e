// SPDX-License-Identifier: GPL-3.0-or-later

// Linear stability of the homogeneously cooling gas: growth rates of plane waves of the rescaled
// fields (delta n / n, u_par / v_0, delta T / T) on the clock tau, and of the transverse velocity.
//
//   [ 0                            -i k l_0                 0                       ]
//   [ -(i k l_0 / 2) d(n z)/dn     gamma_0 (1 - xi_l^2 k^2) -(i k l_0 / 2) z        ]
//   [ -2 gamma_0 g                 -(2 z / d) i k l_0       -gamma_0 (1 + xi_T^2 k^2)]
//
//   transverse: gamma_0 (1 - xi_perp^2 k^2)
//
// T. P. C. van Noije and M. H. Ernst, cond-mat/9907012; symbols as in enskog.hpp.
#pragma once

#include <array>
#include <complex>

#include "analysis/theory/gas.hpp"

namespace haff::analysis {

struct ModeSpectrum {
  double transverse = 0;  // growth rate of the shear mode [1/tau]
  // Longitudinal growth rates [1/tau], by decreasing real part, then imaginary part: at
  // k l_0 << gamma_0 velocity (-> gamma_0), density (-> 0), temperature (-> -gamma_0).
  std::array<std::complex<double>, 3> longitudinal;
};

// Growth rates at wave number k [1/sigma]. Error: rounding of a 3 x 3 eigenproblem, about 1e-15
// of the largest element. Throws std::invalid_argument at e = 1.
ModeSpectrum modes(const Gas& gas, double k);

// The wave numbers below which a mode grows [1/sigma]. A box smaller than 2 pi over one of them is
// stable against that mode. The bound of the heat mode is zero where it never grows.
struct InstabilityBounds {
  double shear = 0;  // 1 / xi_perp
  double heat = 0;   // k^2 = (2 z g / (d(n z)/dn) - 1) / xi_T^2, where the matrix is singular
};
InstabilityBounds instability_bounds(const Gas& gas);

}  // namespace haff::analysis
