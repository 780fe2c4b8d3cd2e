// SPDX-License-Identifier: GPL-3.0-or-later

// Moments of one velocity array: granular temperature and Laguerre (Sonine) coefficients.
//
//   T    = (m/d) <v^2>
//   a_l  = l! Gamma(d/2) / Gamma(l + d/2) < L_l^(d/2 - 1)(c^2) >,   c^2 = v^2 / (2 T / m)
//
// R. Kawahara and H. Nakanishi, cond-mat/0309130. With the moments in units of their Gaussian
// values, M_k = <c^2k> Gamma(d/2) / Gamma(k + d/2), this is the binomial sum
//
//   a_l  = sum_k (-1)^k binomial(l, k) M_k,
//
// which has no large terms to cancel: a_0 = 1 and a_1 = 0 identically, a_2 = M_2 - 1.
#pragma once

#include <array>
#include <span>

namespace haff::analysis {

inline constexpr int highest_laguerre = 6;

// a_0 ... a_6, indexed by l.
using LaguerreCoefficients = std::array<double, highest_laguerre + 1>;

struct Moments {
  double temperature = 0;  // in the unit of m v^2
  LaguerreCoefficients laguerre{};
};

// Moments of the first d components of every velocity, in one pass. The sums run in a fixed order,
// so the same array gives the same bits on every machine. Error: rounding, about 1e-14 relative in
// T and absolute in a_l. Velocities scaled by 2^k give a temperature scaled by 4^k and the same
// coefficients, exactly. If all velocities are zero, T = 0 and the coefficients are NaN. Throws
// std::invalid_argument for an empty array or d other than 2 or 3.
Moments moments(std::span<const std::array<double, 3>> velocity, int d = 3);

// Coefficients from the moments <c^2k>, k = 0 ... 6, of a distribution of c = v/v_0.
LaguerreCoefficients laguerre_from_moments(const LaguerreCoefficients& c_moments, int d = 3);

// Standard error of a_l from N independent Gaussian velocities: sqrt(l! Gamma(d/2) / (Gamma(l +
// d/2) N)), which is sqrt(8/(15 N)) for a_2 in 3-d. (Laguerre polynomials are orthogonal; the use
// of the measured temperature changes a_l by order 1/N.)
double laguerre_noise(int l, double particles, int d = 3);

}  // namespace haff::analysis
