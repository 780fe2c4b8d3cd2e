// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/observables/tail.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analysis/observables/moments.hpp"
#include "analysis/theory/gas.hpp"

namespace haff::analysis {
namespace {

// Speeds c beyond tail_begin, sorted, so that sums do not depend on the order of the particles.
std::vector<double> fast_speeds(std::span<const Vector> velocity, double v0_squared, int d) {
  std::vector<double> speeds;
  for (const Vector& v : velocity) {
    const double planar = v[0] * v[0] + v[1] * v[1];
    const double square = (d == 2 ? planar : planar + v[2] * v[2]) / v0_squared;
    if (square > tail_begin * tail_begin) speeds.push_back(std::sqrt(square));
  }
  std::ranges::sort(speeds);
  return speeds;
}

// The point between `low` and `high` at which f, which has one maximum there, is greatest.
template <class Function>
double where_greatest(double low, double high, Function&& f) {
  constexpr double golden = 0.6180339887498949;
  constexpr double precise = 1e-6;  // [relative]
  double left = high - golden * (high - low), right = low + golden * (high - low);
  double of_left = f(left), of_right = f(right);
  while (high - low > precise * (1 + std::abs(low))) {
    if (of_left < of_right) {
      low = left;
      left = right;
      of_left = of_right;
      right = low + golden * (high - low);
      of_right = f(right);
    } else {
      high = right;
      right = left;
      of_right = of_left;
      left = high - golden * (high - low);
      of_left = f(left);
    }
  }
  return 0.5 * (low + high);
}

// ln of int_3^inf c^(d-1) exp(-A c^alpha) dc, with t = A 3^alpha and c = 3 (1 + x): exp(-t) is
// factored out, and the rest is summed by Simpson's rule.
double log_norm(double t, double alpha, int d) {
  // The integrand falls by a factor of e over about 1/(t alpha); forty times this range holds all
  // of it. [relative]
  const double far = std::min(40 / (t * alpha), 1e3);
  constexpr int steps = 200;
  const double step = std::log1p(far) / steps;  // equal steps of ln c
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double ratio = std::exp(i * step);  // c/3
    const double value = std::pow(ratio, d) * std::exp(-t * (std::pow(ratio, alpha) - 1));
    sum += value * (i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2);
  }
  return d * std::log(tail_begin) - t + std::log(sum * step / 3);
}

double exponent_of(const std::vector<double>& speeds, int d) {
  const auto likelihood = [&](double log_t, double alpha) {
    const double t = std::exp(log_t);
    double mean = 0;  // the mean of (c/3)^alpha
    for (const double c : speeds) mean += std::pow(c / tail_begin, alpha);
    mean /= static_cast<double>(speeds.size());
    return -t * mean - log_norm(t, alpha, d);
  };
  const auto best_of = [&](double alpha) {
    const double log_t =
        where_greatest(-4, 8, [&](double each) { return likelihood(each, alpha); });
    return likelihood(log_t, alpha);
  };
  constexpr double least = 0.05, most = 8;
  return where_greatest(least, most, best_of);
}

}  // namespace

Tail tail(std::span<const Vector> velocity, int d) {
  const double v0_squared = 2 * moments(velocity, d).temperature;
  if (!(v0_squared > 0)) throw std::invalid_argument("the tail of a gas at rest");
  const auto speeds = fast_speeds(velocity, v0_squared, d);

  Tail result{.c = {}, .rho = {}, .particles = speeds.size()};
  const double ball = unit_sphere_surface(d) / d / std::pow(std::numbers::pi, 0.5 * d);
  const auto all = static_cast<double>(velocity.size());
  auto next = speeds.begin();
  double low = tail_begin;
  for (int bin = 0; bin < tail_bins; ++bin) {
    const double high = low * tail_factor;
    const auto end = std::lower_bound(next, speeds.end(), high);
    const double shell = ball * (std::pow(high, d) - std::pow(low, d));
    result.c.push_back(std::sqrt(low * high));
    result.rho.push_back(static_cast<double>(end - next) / (all * shell));
    next = end;
    low = high;
  }
  if (speeds.size() >= fewest_in_tail) result.exponent = exponent_of(speeds, d);
  return result;
}

}  // namespace haff::analysis
