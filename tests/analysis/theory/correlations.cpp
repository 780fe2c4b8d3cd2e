// SPDX-License-Identifier: GPL-3.0-or-later

// Velocity correlations against sum rules and against the same theory in wave-number space.
#include "analysis/theory/correlations.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analysis/theory/cooling.hpp"
#include "analysis/theory/enskog.hpp"
#include "support/relative.hpp"

using haff::tests::off;
using namespace haff::analysis;
using doctest::Approx;
using std::numbers::pi;

namespace {

// Simpson's rule: the tests' own quadrature.
template <class Function>
double simpson(const Function& f, double a, double b, int intervals) {
  const double h = (b - a) / intervals;
  double sum = f(a) + f(b);
  for (int i = 1; i < intervals; ++i) sum += (i % 2 == 0 ? 2 : 4) * f(a + i * h);
  return sum * h / 3;
}

// int_0^S ds e^{s(1 - y)}: the energy that a mode of xi^2 k^2 = y has gathered at s = S.
double gathered(double y, double s) {
  return std::abs(1 - y) < 1e-9 ? s : std::expm1((1 - y) * s) / (1 - y);
}

}  // namespace

TEST_CASE("correlations: the cutoff at n = 0.40 is 1.3888") {
  CHECK(std::abs(cutoff_wavenumber(0.40, 0.30) - 1.3888) < 5e-5);  // four digits given
}

TEST_CASE("correlations: an incompressible field has no divergence") {
  // G_perp = G_par + r/(d-1) dG_par/dr.
  constexpr double h = 1e-3;  // of a central difference: error h^2 times derivatives of order one
  for (const int d : {2, 3}) {
    const Gas gas{.e = 0.8, .n = 0.4, .d = d};
    for (const double r : {2.0, 5.0, 12.0}) {
      const auto at = [&](double x) {
        return velocity_correlation(gas, x, 50, Fluid::incompressible);
      };
      const double slope = (at(r + h).parallel - at(r - h).parallel) / (2 * h);
      const double scale = at(r).parallel;
      CHECK(std::abs(at(r).perpendicular - scale - r / (d - 1) * slope) < 1e-5 * std::abs(scale));
    }
  }
}

TEST_CASE("correlations: the trace is the transform of the modes' energies") {
  // (d-1) G_perp + G_par = T_Haff/(m n) int d^dk/(2pi)^d e^{ikr}
  //                        [(d-1) gathered(xi_perp^2 k^2) + gathered(xi_par^2 k^2) if compressible]
  // in 3-d. The Gaussian in k is cut off beyond the last mode that grows.
  const Gas gas{.e = 0.8, .n = 0.4};
  const Lengths length = lengths(gas);
  const double tau = 50, s = 2 * gamma0(gas.e) * tau, r = 6;
  const auto transform = [&](double xi) {
    // gathered() falls as 1/k^2: subtract the tail without its factor (1 - e^{-..}) exactly,
    // 1/(xi^2k^2 + 1), whose transform is exp(-r/xi) / (4 pi r xi^2), and integrate the rest, which
    // falls as 1/k^4.
    const auto rest = [&](double k) {
      const double y = xi * xi * k * k;
      return k * std::sin(k * r) * (gathered(y, s) - 1 / (1 + y));
    };
    return simpson(rest, 0, 400 / xi, 400000) / (2 * pi * pi * r) +
           std::exp(-r / xi) / (4 * pi * r * xi * xi);
  };
  const double unit = haff_temperature(tau, gas.e) / gas.n;

  const auto trace = [&](Fluid fluid) {
    const auto g = velocity_correlation(gas, r, tau, fluid);
    return 2 * g.perpendicular + g.parallel;
  };
  const double transverse = unit * 2 * transform(length.transverse);
  CHECK(off(trace(Fluid::incompressible), transverse) < 1e-5);
  const double both = transverse + unit * transform(length.longitudinal);
  CHECK(off(trace(Fluid::compressible), both) < 1e-5);
}

TEST_CASE("correlations: without sound modes the compressible fluid is the incompressible one") {
  // At r far below xi_par, and at times at which only xi_perp matters, the longitudinal part is
  // small.
  const Gas gas{.e = 0.98, .n = 0.4};
  const auto simple = velocity_correlation(gas, 3, 100, Fluid::incompressible);
  const auto full = velocity_correlation(gas, 3, 100, Fluid::compressible);
  CHECK(off(full.parallel, simple.parallel) < 0.1);
}

TEST_CASE("correlations: the trace at r = 0 is the sum of all modes below the cutoff") {
  for (const int d : {2, 3}) {
    const Gas gas{.e = 0.85, .n = 0.3, .d = d};
    const double xi = lengths(gas).transverse, k_max = cutoff_wavenumber(gas.n, 0.3, d);
    for (const double tau : {1.0, 30.0, 90.0}) {
      const double s = 2 * gamma0(gas.e, d) * tau;
      const double shells =
          simpson([&](double k) { return std::pow(k, d - 1) * gathered(xi * xi * k * k, s); }, 0,
                  k_max, 20000);
      const double expected = (d - 1) * haff_temperature(tau, gas.e, d) / gas.n *
                              unit_sphere_surface(d) / std::pow(2 * pi, d) * shells;
      CHECK(off(correlation_trace(gas, tau, 0.3), expected) < 1e-8);
    }
  }
}

TEST_CASE("correlations: growth starts from its finite limit q^d / d without a step") {
  for (const int d : {2, 3}) {
    const TraceGrowth growth({.e = 0.9, .n = 0.4, .d = d}, 0.3);
    CHECK(off(growth(0), std::pow(growth.q, d) / d) < 1e-14);
    // Across the switch from series to incomplete gamma function.
    const double change = 1e-4 / (growth.q * growth.q);
    CHECK(off(growth(1.0001 * change), growth(0.9999 * change)) < 1e-7);
  }
}

TEST_CASE("correlations: they are zero at tau = 0") {
  CHECK(velocity_correlation({.e = 0.8}, 1, 0, Fluid::incompressible).parallel == 0);
  CHECK(correlation_trace({.e = 0.8}, 0) == 0);
}

TEST_CASE("correlations: bad input is refused") {
  CHECK_THROWS_AS(velocity_correlation({.e = 1}, 1, 1, Fluid::incompressible),
                  std::invalid_argument);
  CHECK_THROWS_AS(velocity_correlation({.e = 0.8}, 0, 1, Fluid::incompressible),
                  std::invalid_argument);
  CHECK_THROWS_AS(correlation_trace({.e = 0.8}, -1), std::invalid_argument);
}
