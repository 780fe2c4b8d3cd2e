// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/equilibrium.hpp"

#include <cmath>
#include <cstddef>

#include "analysis/observables/moments.hpp"

namespace haff::analysis {
namespace {

constexpr double standard_errors = 4;

}  // namespace

double equilibrium_laguerre(int l, double particles, int d) {
  const double dimensions = d * (particles - 1.0);
  double moment = 1;  // <c^2k> over its Gaussian value
  double binomial = 1;
  double sum = 0;
  for (int k = 0; k <= l; ++k) {
    sum += (k % 2 == 0 ? 1 : -1) * binomial * moment;
    binomial *= static_cast<double>(l - k) / (k + 1);
    moment /= 1 + 2.0 * k / dimensions;
  }
  return sum;
}

bool is_equilibrated(const std::array<std::optional<double>, 3>& a2_to_a4, double particles,
                     int d) {
  for (int l = 2; l <= 4; ++l) {
    const auto& a = a2_to_a4[static_cast<std::size_t>(l - 2)];
    const double allowed = standard_errors * laguerre_noise(l, particles, d);
    if (!a || !(std::abs(*a - equilibrium_laguerre(l, particles, d)) <= allowed)) return false;
  }
  return true;
}

}  // namespace haff::analysis
