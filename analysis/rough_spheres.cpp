#include "analysis/rough_spheres.hpp"

#include <cmath>
#include <limits>

namespace haff::analysis {
namespace {

struct Rates {
  Rates(double e, const Roughness& roughness) {
    const double q = roughness.q;
    const double eta = q * (1 + roughness.beta) / (2 * (1 + q));
    a = (1 - e * e) / 4 + eta * (1 - eta);
    b = eta * eta / q;
    c = eta / q * (1 - eta / q);
  }
  double a, b, c;
};

}  // namespace

double rough_temperature_ratio(double e, const Roughness& roughness) {
  const Rates rates(e, roughness);
  if (rates.b == 0) return std::numeric_limits<double>::infinity();
  const double h = (rates.a - rates.c) / (2 * rates.b);
  const double root = std::sqrt(1 + h * h);
  return h > 0 ? h + root : 1 / (root - h);  // without cancellation
}

// Linear in T and R on the clock tau: the exponential of a symmetric matrix.
RoughTemperatures rough_temperatures(double tau, double e, const Roughness& roughness,
                                     const RoughTemperatures& start) {
  const Rates rates(e, roughness);
  const double mean = (rates.a + rates.c) / 2;
  const double half = (rates.a - rates.c) / 2;
  const double spread = std::sqrt(half * half + rates.b * rates.b);
  const double x = 4.0 / 3 * tau;
  const double decay = std::exp(-mean * x);
  const double even = std::cosh(spread * x);
  const double odd = spread > 0 ? std::sinh(spread * x) / spread : x;
  const auto [T, R] = start;
  return {.translation = decay * (even * T + odd * (rates.b * R - half * T)),
          .rotation = decay * (even * R + odd * (rates.b * T + half * R))};
}

}  // namespace haff::analysis
