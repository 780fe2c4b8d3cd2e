// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/theory/enskog_boltzmann.hpp"

#include <cmath>

namespace haff::analysis {
namespace {

double source(double e, int d) {
  return (e * e - 1) * (2 * e * e - 1) / (d * (d + 2));
}

double relaxation(double e, int d) {
  const double bracket = 9 + 24 * d + 8 * e * d - 41 * e + 30 * (1 - e) * e * e;
  return -(1 + e) * bracket / (16 * d * (d + 2));
}

}  // namespace

double boltzmann_a2(double tau, double e, int d) {
  return boltzmann_a2_plateau(e, d) * -std::expm1(relaxation(e, d) * tau);
}

double boltzmann_a2_plateau(double e, int d) {
  return -source(e, d) / relaxation(e, d);
}

InitialSlopes boltzmann_initial_slopes(double e, int d) {
  // The mean loss of h_n^2, h_n^4 and h_n^6 in a collision, in powers of T/m.
  const double e2 = e * e;
  const double second = e2 - 1;
  const double fourth = 2 * (e2 * e2 - 1);
  const double sixth = 6 * (e2 * e2 * e2 - 1);
  // v_1^2 = S + P and v_2^2 = S - P with S = V^2 + h^2 and P = 2 V.h, so that the sum of v^6 is
  // 2 (S^3 + 3 S P^2). V^2 and the part of h across the normal are m = 2d - 1 squares.
  const double m = 2 * d - 1;
  const double v6 = second * (0.75 * m * (m + 2) + 3 * (m + 2) + 3 * (d - 1)) +
                    fourth * (1.5 * m + 6) + sixth;  // d<v^6>/dtau [(T/m)^3]
  const double a2 = source(e, d);                    // d(a_2)/dtau = dM_2/dtau, M_2 = 1 + a_2
  const double m3 = v6 / (d * (d + 2) * (d + 4)) - 3 * second / d;  // because T changes
  return {.a2 = a2, .a3 = 3 * a2 - m3};
}

double heated_a2(double e, int d) {
  const double bracket = 73 + 56 * d - 24 * e * d - 105 * e + 30 * (1 - e) * e * e;
  return 16 * (1 - e) * (1 - 2 * e * e) / bracket;
}

double boltzmann_rate_ratio(double a2) {
  return 1 - a2 / 16;
}

double boltzmann_gamma_ratio(double a2) {
  return (1 + 3 * a2 / 16) / boltzmann_rate_ratio(a2);
}

}  // namespace haff::analysis
