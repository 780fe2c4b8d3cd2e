// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/theory/self_diffusion.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analysis/theory/enskog.hpp"

namespace haff::analysis {
namespace {

// D in all Sonine approximations over D in the first, for spheres.
constexpr double higher_approximations = 1.019;

}  // namespace

double self_diffusion_per_collision(double n, int d) {
  const double rate = transport(n, 1, d).collision_rate;
  return (d == 3 ? higher_approximations : 1) * d / (2 * rate * rate);
}

double simulated_self_diffusion_per_collision(double n) {
  constexpr double densest = 1.08;
  if (n > densest) throw std::invalid_argument("no simulation knows D of so dense a gas");
  const double square = n * n;
  const double fitted = (1 - n / 1.09) * (1 + square * (0.4 - 0.83 * square));
  return 3 / (8 * n) * std::sqrt(1 / std::numbers::pi) * fitted / transport(n, 1).collision_rate;
}

double enskog_autocorrelation(double tau, int d) {
  return std::exp(-2 * tau / d);
}

}  // namespace haff::analysis
