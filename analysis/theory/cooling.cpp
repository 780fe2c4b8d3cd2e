// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/theory/cooling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace haff::analysis {
namespace {

// Gauss-Legendre quadrature on [-1, 1] with three nodes, exact for polynomials up to the fifth
// degree: places sqrt(3/5), weights 5/9 and 8/9.
const double sqrt_three_fifths = std::sqrt(0.6);
const std::array<double, 3> gauss_place{-sqrt_three_fifths, 0, sqrt_three_fifths};
constexpr std::array<double, 3> gauss_weight{5.0 / 9, 8.0 / 9, 5.0 / 9};

}  // namespace

double gamma0(double e, int d) {
  return (1 - e * e) / (2 * d);
}

double initial_temperature(int d) {
  return 2.0 / d;
}

double haff_temperature(double tau, double e, int d) {
  return initial_temperature(d) * std::exp(-2 * gamma0(e, d) * tau);
}

double gamma_ratio(double before, double after, double interval, double e, int d) {
  const double rate = gamma0(e, d);
  if (rate == 0) return std::numeric_limits<double>::quiet_NaN();
  return std::log(before / after) / (2 * rate * interval);
}

double collision_rate(double pair_collisions, double particles, double elapsed) {
  return 2 * pair_collisions / (particles * elapsed);
}

double mean_temperature(std::span<const double> time, std::span<const double> temperature) {
  constexpr std::size_t most_nodes = 4;
  if (time.size() != temperature.size() || time.size() < 2)
    throw std::invalid_argument("mean_temperature: two samples are needed, and a time for each");
  const std::size_t nodes = std::min(time.size(), most_nodes);
  time = time.last(nodes);
  std::array<double, most_nodes> difference{};  // Newton's divided differences of T^(-1/2)
  for (std::size_t i = 0; i < nodes; ++i)
    difference[i] = 1 / std::sqrt(temperature[temperature.size() - nodes + i]);
  const double before = difference[nodes - 2], after = difference[nodes - 1];
  for (std::size_t order = 1; order < nodes; ++order)
    for (std::size_t i = nodes - 1; i >= order; --i)
      difference[i] = (difference[i] - difference[i - 1]) / (time[i] - time[i - order]);
  const auto interpolated = [&](double t) {
    double value = difference[nodes - 1];
    for (std::size_t i = nodes - 1; i > 0; --i)
      value = difference[i - 1] + (t - time[i - 1]) * value;
    return value;
  };

  // With the straight line l(t) between the last two nodes and w = 1/l, dt/l^2 is proportional to
  // dw. The integrand is then (l/y)^2, which is 1 where Haff's law holds.
  const double begin = time[nodes - 2], end = time[nodes - 1];
  const double slope = (after - before) / (end - begin);
  double mean = 0;
  for (std::size_t k = 0; k < gauss_place.size(); ++k) {
    const double part = 0.5 * (1 + gauss_place[k]);
    const double w = 1 / before + part * (1 / after - 1 / before);
    // t from w. Between equal temperatures w is constant, and t takes its place.
    const double t =
        after == before ? begin + part * (end - begin) : begin + (1 / w - before) / slope;
    const double ratio = 1 / (w * interpolated(t));
    mean += 0.5 * gauss_weight[k] * ratio * ratio;
  }
  const double geometric = 1 / (before * after);
  return std::isfinite(mean) ? mean * geometric : geometric;
}

double pressure(double n, double temperature, double virial, double particles, double elapsed,
                int d) {
  const double volume = particles / n;
  return n * temperature + virial / (d * volume * elapsed);
}

std::optional<double> tau_c(std::span<const double> tau, std::span<const double> temperature,
                            double e, int d) {
  if (tau.size() != temperature.size()) {
    throw std::invalid_argument("tau_c: as many temperatures as times are needed");
  }
  // Only logarithms are used: T_Haff itself underflows in long runs.
  const auto excess = [&](std::size_t i) {
    return std::log(temperature[i] / initial_temperature(d)) + 2 * gamma0(e, d) * tau[i];
  };
  for (std::size_t i = 1; i < tau.size(); ++i) {
    const double here = excess(i);
    if (here < std::numbers::ln2) continue;
    const double before = excess(i - 1);
    const double fraction = (std::numbers::ln2 - before) / (here - before);
    return tau[i - 1] + fraction * (tau[i] - tau[i - 1]);
  }
  return std::nullopt;
}

}  // namespace haff::analysis
