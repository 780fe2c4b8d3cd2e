// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/displacements.hpp"

#include <cmath>
#include <stdexcept>

namespace haff::analysis {
namespace {

void must_match(std::span<const Vector> now, std::span<const Vector> before) {
  if (now.empty() || now.size() != before.size())
    throw std::invalid_argument("displacements need the same particles twice");
}

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

double mean_square_displacement(std::span<const Vector> now, std::span<const Vector> before) {
  must_match(now, before);
  double sum = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Vector way{now[i][0] - before[i][0], now[i][1] - before[i][1], now[i][2] - before[i][2]};
    sum += dot(way, way);
  }
  return sum / static_cast<double>(now.size());
}

double velocity_autocorrelation(std::span<const Vector> now, std::span<const Vector> before) {
  must_match(now, before);
  double both = 0, of_now = 0, of_before = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    both += dot(now[i], before[i]);
    of_now += dot(now[i], now[i]);
    of_before += dot(before[i], before[i]);
  }
  const double norm = std::sqrt(of_now) * std::sqrt(of_before);
  return norm > 0 ? both / norm : 0;
}

}  // namespace haff::analysis
