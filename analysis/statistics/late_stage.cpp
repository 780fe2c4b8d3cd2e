// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/statistics/late_stage.hpp"

#include <gsl/gsl_fit.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "analysis/gsl.hpp"

namespace haff::analysis {

PowerLaw late_exponent(std::span<const double> tau, std::span<const double> temperature,
                       double from, double to) {
  if (tau.size() != temperature.size())
    throw std::invalid_argument("late exponent: as many temperatures as times are needed");
  std::vector<double> x, y;
  for (std::size_t i = 0; i < tau.size(); ++i) {
    if (tau[i] < from || tau[i] > to || !(tau[i] > 0) || !(temperature[i] > 0)) continue;
    x.push_back(std::log(tau[i]));
    y.push_back(std::log(temperature[i]));
  }
  if (x.size() < 3)
    throw std::invalid_argument("late exponent: at least three samples in the range are needed");
  gsl::report_errors();
  double intercept = 0, slope = 0, var_intercept = 0, covariance = 0, var_slope = 0, squares = 0;
  gsl::check(gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &intercept, &slope, &var_intercept,
                            &covariance, &var_slope, &squares),
             "late exponent");
  return {
      .exponent = slope, .standard_error = std::sqrt(var_slope), .prefactor = std::exp(intercept)};
}

}  // namespace haff::analysis
