// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/theory/self_diffusion.hpp"

#include <cmath>

#include "analysis/theory/enskog.hpp"

namespace haff::analysis {
namespace {

// All Sonine approximations over the first, of spheres.
constexpr double higher_approximations = 1.019;

}  // namespace

double self_diffusion_per_collision(double n, int d) {
  const double rate = transport(n, 1, d).collision_rate;
  return (d == 3 ? higher_approximations : 1) * d / (2 * rate * rate);
}

double enskog_autocorrelation(double tau, int d) {
  return std::exp(-2 * tau / d);
}

}  // namespace haff::analysis
