// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/theory/rough_spheres.hpp"

#include <cmath>
#include <limits>

namespace haff::analysis {
namespace {

// dT/dtau = -translation T + b R, and dR/dtau = -rotation R + c T.
struct Rates {
  Rates(double e, const Roughness& roughness) {
    const double q = roughness.q;
    const double d = roughness.d;
    const double eta = q * (1 + roughness.beta) / (2 * (1 + q));
    const double to_t = 2 * (d - 1) / d;
    const double to_r = 2 * (d - 1) / (d * (d - 1) / 2);
    translation = to_t * ((1 - e * e) / (2 * (d - 1)) + eta * (1 - eta));
    rotation = to_r * (eta / q * (1 - eta / q));
    b = to_t * (eta * eta / q);
    c = to_r * (eta * eta / q);
  }
  double translation, rotation, b, c;
};

}  // namespace

double rough_temperature_ratio(double e, const Roughness& roughness) {
  const Rates rates(e, roughness);
  if (rates.b == 0) return std::numeric_limits<double>::infinity();
  const double h = (rates.translation - rates.rotation) / (2 * rates.b);
  const double r = rates.c / rates.b;
  const double root = std::sqrt(r + h * h);
  return h > 0 ? h + root : r / (root - h);  // without cancellation
}

// The equations are linear in T and R on the clock tau: the solution is the exponential of a
// matrix.
RoughTemperatures rough_temperatures(double tau, double e, const Roughness& roughness,
                                     const RoughTemperatures& start) {
  const Rates rates(e, roughness);
  const double mean = (rates.translation + rates.rotation) / 2;
  const double half = (rates.translation - rates.rotation) / 2;
  const double spread = std::sqrt(half * half + rates.b * rates.c);
  const double decay = std::exp(-mean * tau);
  const double even = std::cosh(spread * tau);
  const double odd = spread > 0 ? std::sinh(spread * tau) / spread : tau;
  const auto [T, R] = start;
  return {.translation = decay * (even * T + odd * (rates.b * R - half * T)),
          .rotation = decay * (even * R + odd * (rates.c * T + half * R))};
}

}  // namespace haff::analysis
