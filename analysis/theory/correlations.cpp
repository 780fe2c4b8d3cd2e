// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/theory/correlations.hpp"

#include <gsl/gsl_sf_gamma.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analysis/integral.hpp"
#include "analysis/theory/cooling.hpp"
#include "analysis/theory/enskog.hpp"

namespace haff::analysis {
namespace {

using std::numbers::pi;

// Lower incomplete gamma function, not normalized.
double lower_gamma(double a, double x) {
  return gsl_sf_gamma_inc_P(a, x) * gsl_sf_gamma(a);
}

// gamma(a, x) / x^a, which is finite at x = 0: 1/a - x/(a+1) + x^2/(2(a+2)) - ...
double reduced_lower_gamma(double a, double x) {
  constexpr double small = 1e-4;  // the first term left out is x^4/(24(a+4)) < 1e-18
  if (x < small) return 1 / a - x / (a + 1) + x * x / (2 * (a + 2)) - x * x * x / (6 * (a + 3));
  return lower_gamma(a, x) / std::pow(x, a);
}

// The diffusion kernel exp(-x^2/4s) / (xi^d (4 pi s)^(d/2)).
double kernel(double x_squared, double xi, double s, int d) {
  return std::exp(-x_squared / (4 * s)) / std::pow(xi * std::sqrt(4 * pi * s), d);
}

void require_time(double tau) {
  if (!(tau >= 0)) throw std::invalid_argument("velocity correlations need tau >= 0");
}

}  // namespace

VelocityCorrelation velocity_correlation(const Gas& gas, double r, double tau, Fluid fluid) {
  if (!(r > 0)) throw std::invalid_argument("velocity correlations need a distance r > 0");
  require_time(tau);
  const int d = gas.d;
  const Lengths length = lengths(gas);
  const double x2_perp = std::pow(r / length.transverse, 2);
  const double x2_par = std::pow(r / length.longitudinal, 2);
  const double geometry = 1 / (2 * std::pow(pi, 0.5 * d) * std::pow(r, d));
  const bool compressible = fluid == Fluid::compressible;

  const auto vortex = [&](double s) {  // the term of both components, over sigma_l (d-1)^[l = par]
    double gamma = lower_gamma(0.5 * d, x2_perp / (4 * s));
    if (compressible) gamma -= lower_gamma(0.5 * d, x2_par / (4 * s));
    return geometry * gamma;
  };
  const auto parallel = [&](double s) {
    double bracket = (d - 1) * vortex(s);
    if (compressible) bracket += kernel(x2_par, length.longitudinal, s, d);
    return std::exp(s) * bracket;
  };
  const auto perpendicular = [&](double s) {
    return std::exp(s) * (kernel(x2_perp, length.transverse, s, d) - vortex(s));
  };

  constexpr double relative = 1e-9, absolute = 1e-14;
  const double s = 2 * gamma0(gas.e, d) * tau;
  if (s == 0) return {};
  const double unit = haff_temperature(tau, gas.e, d) / gas.n;
  const double tolerance = absolute * std::exp(s);
  return {.parallel = unit * integral(parallel, 0, s, relative, tolerance),
          .perpendicular = unit * integral(perpendicular, 0, s, relative, tolerance)};
}

double cutoff_wavenumber(double n, double b, int d) {
  return 2 * pi * std::pow(n, 1.0 / d) * b;
}

TraceGrowth::TraceGrowth(const Gas& gas, double b) : d(gas.d) {
  const double xi = lengths(gas).transverse;
  strength = (d - 1) * unit_sphere_surface(d) / (gas.n * std::pow(2 * pi * xi, d));
  q = xi * cutoff_wavenumber(gas.n, b, d);
}

double TraceGrowth::operator()(double s) const {
  return 0.5 * std::exp(s) * std::pow(q, d) * reduced_lower_gamma(0.5 * d, s * q * q);
}

double correlation_trace(const Gas& gas, double tau, double b) {
  require_time(tau);
  const TraceGrowth growth(gas, b);
  const double s = 2 * gamma0(gas.e, gas.d) * tau;
  return haff_temperature(tau, gas.e, gas.d) * growth.strength * integral(growth, 0, s, 1e-10, 0);
}

}  // namespace haff::analysis
