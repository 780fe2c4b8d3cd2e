// SPDX-License-Identifier: GPL-3.0-or-later

// Spatial correlations of the velocity field in the cooling gas, from linear fluctuating
// hydrodynamics.
//
//   G_par(r)  = < (u(r) . rhat)(u(0) . rhat) >,   G_perp(r) = (< u(r) . u(0) > - G_par) / (d-1)
//   G_l^+     = (T_Haff / (m n)) int_0^{2 gamma_0 tau} ds e^s {
//                 sigma_l (d-1)^[l = par] / (2 pi^(d/2) r^d) gamma(d/2, x_perp^2 / 4s)
//                 + [l = perp] xi_perp^-d exp(-x_perp^2 / 4s) / (4 pi s)^(d/2) }
//
// in an incompressible fluid, with x_l = r / xi_l, sigma_par = 1, sigma_perp = -1 and gamma(a, x)
// the lower incomplete gamma function. With compression the bracket becomes
//
//   sigma_l (d-1)^[l = par] / (2 pi^(d/2) r^d) (gamma(d/2, x_perp^2/4s) - gamma(d/2, x_par^2/4s))
//   + xi_l^-d exp(-x_l^2 / 4s) / (4 pi s)^(d/2)        for both l.
//
// The superscript + means: without the self part at r = 0. T. P. C. van Noije, M. H. Ernst, R.
// Brito and J. A. G. Orza, Phys. Rev. Lett. 79, 411 (1997); R. Kawahara and H. Nakanishi,
// cond-mat/0309130.
#pragma once

#include "analysis/theory/gas.hpp"

namespace haff::analysis {

enum class Fluid { incompressible, compressible };

struct VelocityCorrelation {
  double parallel = 0;       // G_par^+ [E(0)/m]
  double perpendicular = 0;  // G_perp^+ [E(0)/m]
};

// The correlation at distance r > 0 [sigma] and time tau. Quadrature error below 1e-9 relative or
// 1e-14 of T_Haff / (m n sigma^d). Throws std::invalid_argument at e = 1, r <= 0 or tau < 0.
VelocityCorrelation velocity_correlation(const Gas& gas, double r, double tau, Fluid fluid);

// The cutoff of the linear theory, k_M = 2 pi n^(1/d) b, where b is one number fitted for all e and
// n.
inline constexpr double cutoff_b = 0.30;
double cutoff_wavenumber(double n, double b = cutoff_b, int d = 3);  // [1/sigma]

// Growth of Tr G^+(0) on the clock s = 2 gamma_0 tau: Tr G^+(0) = T_Haff strength int_0^s ds'
// trace_density(s'). Both the trace and the energy equation use it.
//   strength      = (d-1) Omega_d / (m n (2 pi xi_perp)^d)
//   trace_density = e^s / (2 s^(d/2)) gamma(d/2, s xi_perp^2 k_M^2), q^d / d at s = 0
struct TraceGrowth {
  TraceGrowth(const Gas& gas, double b);
  double operator()(double s) const;  // trace_density

  double strength;  // [1/m]
  double q;         // xi_perp k_M
  int d;
};

// Tr G^+(0, tau) = (d-1) G_perp^+ + G_par^+ at r -> 0, cut off at k_M [E(0)/m]. Quadrature error
// below 1e-10 relative. Throws std::invalid_argument at e = 1 or tau < 0.
double correlation_trace(const Gas& gas, double tau, double b = cutoff_b);

}  // namespace haff::analysis
