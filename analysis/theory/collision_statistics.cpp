// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/theory/collision_statistics.hpp"

#include <gsl/gsl_sf_bessel.h>

#include <cmath>
#include <numbers>

#include "analysis/integral.hpp"
#include "analysis/theory/gas.hpp"

namespace haff::analysis {

double relative_collision_rate(double c, int d) {
  const double c2 = c * c;
  if (d == 2)
    return ((1 + c2) * gsl_sf_bessel_I0_scaled(c2 / 2) + c2 * gsl_sf_bessel_I1_scaled(c2 / 2)) /
           std::numbers::sqrt2;
  constexpr double small = 1e-4;  // below, erf(c)/c is 2/sqrt(pi) (1 - c^2/3) to 1e-17
  const double root = std::sqrt(std::numbers::pi);
  const double erf_over_c = c < small ? 2 / root * (1 - c2 / 3) : std::erf(c) / c;
  return (std::exp(-c2) + (2 * c2 + 1) * (root / 2) * erf_over_c) / std::sqrt(8.0);
}

double free_time_density(double u, int d) {
  // Beyond this speed the Gaussian weight is below 1e-30.
  constexpr double fastest = 8.5;
  constexpr double relative = 1e-8;
  const double surface = unit_sphere_surface(d) / std::pow(std::numbers::pi, 0.5 * d);
  return integral(
      [&](double c) {
        const double rate = relative_collision_rate(c, d);
        return surface * std::pow(c, d - 1) * std::exp(-c * c - rate * u) * rate * rate;
      },
      0, fastest, relative, 0);
}

double normal_speed_density(double w) {
  return w * std::exp(-0.5 * w * w);
}

}  // namespace haff::analysis
