// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/statistics/accuracy.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/gsl.hpp"

namespace haff::analysis {
namespace {

double fitted_slope(std::span<const GroupScatter> scatter) {
  std::vector<double> x, y, weight;
  for (const GroupScatter& each : scatter) {
    const auto degrees = static_cast<double>(each.groups - 1);
    x.push_back(std::log(static_cast<double>(each.size)));
    y.push_back(std::log(each.scatter) + 1 / (2 * degrees));
    weight.push_back(degrees);
  }
  double c0 = 0, c1 = 0, cov00 = 0, cov01 = 0, cov11 = 0, chi2 = 0;
  gsl_fit_wlinear(x.data(), 1, weight.data(), 1, y.data(), 1, x.size(), &c0, &c1, &cov00, &cov01,
                  &cov11, &chi2);
  return c1;
}

}  // namespace

double student_t(std::size_t degrees, double confidence) {
  if (degrees == 0) throw std::invalid_argument("Student's t of no degrees of freedom");
  return gsl_cdf_tdist_Pinv(0.5 + confidence / 2, static_cast<double>(degrees));
}

double standard_deviation(const Estimate& estimate) {
  return estimate.standard_error * std::sqrt(static_cast<double>(estimate.count));
}

double half_interval(const Estimate& scatter, std::size_t count, double confidence) {
  return student_t(scatter.count - 1, confidence) * standard_deviation(scatter) /
         std::sqrt(static_cast<double>(count));
}

std::vector<GroupScatter> group_scatter(std::span<const double> values, std::size_t fewest_groups) {
  std::vector<GroupScatter> all;
  for (std::size_t size = 1; values.size() / size >= std::max<std::size_t>(fewest_groups, 2);
       size *= 2) {
    std::vector<double> means(values.size() / size);
    for (std::size_t g = 0; g < means.size(); ++g)
      means[g] = estimate(values.subspan(g * size, size)).mean;
    const double scatter = standard_deviation(estimate(means));
    const auto degrees = static_cast<double>(means.size() - 1);
    all.push_back({.size = size,
                   .groups = means.size(),
                   .scatter = scatter,
                   .error = scatter / std::sqrt(2 * degrees)});
  }
  return all;
}

Slope scatter_slope(std::span<const GroupScatter> scatter) {
  if (scatter.size() < 2) throw std::invalid_argument("slope of fewer than two sizes of groups");
  constexpr int sets = 1000;
  constexpr unsigned long seed = 20030905;
  gsl::report_errors();
  const gsl::Owned<gsl_rng, gsl_rng_free> random(gsl_rng_alloc(gsl_rng_mt19937));
  gsl_rng_set(random.get(), seed);

  std::vector<double> values(scatter.front().groups);
  const std::size_t fewest_groups = scatter.back().groups;
  double squares = 0;
  for (int set = 0; set < sets; ++set) {
    for (double& each : values) each = gsl_ran_gaussian(random.get(), 1);
    squares += std::pow(fitted_slope(group_scatter(values, fewest_groups)) + 0.5, 2);
  }
  return {.value = fitted_slope(scatter), .error = std::sqrt(squares / sets)};
}

std::size_t realizations_needed(double deviation, double se) {
  if (!(se > 0)) throw std::invalid_argument("a standard error must be above 0");
  const double needed = std::ceil(std::pow(deviation / se, 2));
  constexpr double most = 1e15;  // more than can be run, and still exact as a double
  return std::max<std::size_t>(2, static_cast<std::size_t>(std::min(needed, most)));
}

std::size_t next_realizations(const Estimate& so_far, double se) {
  if (so_far.count < 2) throw std::invalid_argument("fewer than two values have no scatter");
  if (so_far.standard_error <= se) return so_far.count;
  const std::size_t needed = realizations_needed(standard_deviation(so_far), se);
  return std::min(2 * so_far.count, std::max(needed, so_far.count + 1));
}

}  // namespace haff::analysis
