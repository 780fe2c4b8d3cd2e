// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/theory/spectrum.hpp"

#include <cmath>
#include <numbers>

#include "analysis/theory/cooling.hpp"
#include "analysis/theory/enskog.hpp"

namespace haff::analysis {

double equilibrium_spectrum(double k, double n, double temperature, bool is_parallel, int d) {
  const double modes =
      unit_sphere_surface(d) * std::pow(k, d - 1) / (n * std::pow(2 * std::numbers::pi, d));
  return 0.5 * modes * temperature * (is_parallel ? 1 : d - 1);
}

double spectrum_ratio(const Gas& gas, double k, double tau, bool is_parallel) {
  const Lengths length = lengths(gas);
  const double xi = is_parallel ? length.longitudinal : length.transverse;
  const double s = 2 * gamma0(gas.e, gas.d) * tau;
  const double rest = 1 - xi * xi * k * k;
  constexpr double nearly_zero = 1e-8;  // below, the quotient is s to that order
  return 1 + (std::abs(rest * s) < nearly_zero ? s : std::expm1(s * rest) / rest);
}

}  // namespace haff::analysis
