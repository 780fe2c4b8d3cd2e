// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/theory/energy_equation.hpp"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <gsl/gsl_odeiv2.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analysis/gsl.hpp"
#include "analysis/theory/cooling.hpp"
#include "analysis/theory/enskog_boltzmann.hpp"

namespace haff::analysis {
namespace {

// F and I of the equation, carried forward on s = 2 gamma_0 tau by GSL's Prince-Dormand stepper.
class Solution {
 public:
  Solution(const Gas& gas, double b, Velocities velocities)
      : gas_(gas), velocities_(velocities), growth_(gas, b), decay_(2 * gamma0(gas.e, gas.d)) {
    gsl::report_errors();
    system_ = {derivative, nullptr, state_.size(), this};
    driver_.reset(gsl_odeiv2_driver_alloc_y_new(&system_, gsl_odeiv2_step_rk8pd, first_step,
                                                tolerance, tolerance));
  }

  Solution(const Solution&) = delete;  // GSL holds the address of the object
  Solution& operator=(const Solution&) = delete;

  // Advances to s, which is not before the present one.
  void advance(double s) {
    if (s > s_) {
      const int status = gsl_odeiv2_driver_apply(driver_.get(), &s_, s, state_.data());
      caught_.rethrow();
      gsl::check(status, "energy equation");
    }
  }

  double s() const { return s_; }
  double energy_over_haff() const { return state_[0]; }
  double slope() const { return slope(s_, state_.data()); }  // dF/ds

  EnergyPoint point() const {
    const double haff = std::exp(-s_);
    return {.tau = s_ / decay_,
            .energy = haff * energy_over_haff(),
            .haff = haff,
            .gamma_ratio = 1 - slope() / energy_over_haff()};
  }
  double decay() const { return decay_; }

 private:
  static constexpr double first_step = 1e-3;  // in s; the driver adapts it
  static constexpr double tolerance = 1e-11;  // per step, absolute and relative

  double loss_factor(double s) const {
    if (velocities_ == Velocities::gaussian) return 1;
    return boltzmann_gamma_ratio(boltzmann_a2(s / decay_, gas_.e, gas_.d));
  }

  double slope(double s, const double y[]) const {
    const double f = loss_factor(s);
    return (1 - f) * y[0] + f * growth_.strength / growth_.d * y[1];
  }

  static int derivative(double s, const double y[], double dydt[], void* self) {
    auto& solution = *static_cast<Solution*>(self);
    return solution.caught_.status_of([&] {
      dydt[0] = solution.slope(s, y);
      dydt[1] = solution.growth_(s);
    });
  }

  Gas gas_;
  Velocities velocities_;
  TraceGrowth growth_;
  double decay_;
  gsl::Caught caught_;
  gsl_odeiv2_system system_{};
  gsl::Owned<gsl_odeiv2_driver, gsl_odeiv2_driver_free> driver_;
  std::array<double, 2> state_ = {1, 0};
  double s_ = 0;
};

}  // namespace

std::vector<EnergyPoint> energy_equation(const Gas& gas, std::span<const double> tau, double b,
                                         Velocities velocities) {
  Solution solution(gas, b, velocities);
  std::vector<EnergyPoint> points;
  points.reserve(tau.size());
  double last = 0;
  for (const double each : tau) {
    if (!(each >= last)) throw std::invalid_argument("energy equation: tau must not decrease");
    solution.advance(solution.decay() * each);
    points.push_back(solution.point());
    points.back().tau = last = each;
  }
  return points;
}

double energy_equation_tau_c(const Gas& gas, double b, Velocities velocities) {
  constexpr double stride = 0.25;      // in s; F grows by a factor of e^stride at most
  constexpr double converged = 1e-11;  // relative
  Solution solution(gas, b, velocities);
  while (solution.energy_over_haff() < 2) solution.advance(solution.s() + stride);

  // F is convex, so Newton's steps from beyond the crossing approach it from above.
  double s = solution.s();
  for (int step = 0; step < 50; ++step) {
    Solution here(gas, b, velocities);
    here.advance(s);
    const double change = (here.energy_over_haff() - 2) / here.slope();
    s -= change;
    if (std::abs(change) < converged * s) return s / here.decay();
  }
  throw std::runtime_error("energy equation: tau_c did not converge");
}

namespace {

// A measured ln E(tau), tau > 0, with its weights.
struct Measured {
  Gas gas;
  Velocities velocities = Velocities::gaussian;
  std::vector<double> tau, log_energy, log_error;
  gsl::Caught caught = {};  // from residuals()
};

Measured measured(const Gas& gas, std::span<const double> tau, std::span<const double> energy,
                  std::span<const double> energy_error, Velocities velocities) {
  if (tau.size() != energy.size() || (!energy_error.empty() && energy_error.size() != tau.size())) {
    throw std::invalid_argument("fit of b: as many energies (and errors) as times are needed");
  }
  Measured result{
      .gas = gas, .velocities = velocities, .tau = {}, .log_energy = {}, .log_error = {}};
  for (std::size_t i = 0; i < tau.size(); ++i) {
    if (tau[i] == 0) continue;  // E(0) = 1 by preparation: it says nothing about b
    const double error = energy_error.empty() ? 1 : energy_error[i] / energy[i];
    if (!(error > 0) || !std::isfinite(std::log(energy[i]))) {
      throw std::invalid_argument("fit of b: energies and their errors must be positive");
    }
    result.tau.push_back(tau[i]);
    result.log_energy.push_back(std::log(energy[i]));
    result.log_error.push_back(error);
  }
  if (result.tau.size() < 2) {
    throw std::invalid_argument("fit of b: at least two samples at tau > 0 are needed");
  }
  return result;
}

// Residuals in standard errors; the parameter is ln b, which keeps b positive.
int residuals(const gsl_vector* log_b, void* data, gsl_vector* result) {
  auto& series = *static_cast<Measured*>(data);
  return series.caught.status_of([&] {
    const auto theory = energy_equation(series.gas, series.tau, std::exp(gsl_vector_get(log_b, 0)),
                                        series.velocities);
    for (std::size_t i = 0; i < theory.size(); ++i) {
      const double difference = std::log(theory[i].energy) - series.log_energy[i];
      gsl_vector_set(result, i, difference / series.log_error[i]);
    }
  });
}

}  // namespace

CutoffFit fit_cutoff(const Gas& gas, std::span<const double> tau, std::span<const double> energy,
                     std::span<const double> energy_error, Velocities velocities) {
  constexpr std::size_t most_iterations = 50;
  constexpr double step_tolerance = 1e-8, gradient_tolerance = 1e-10;
  Measured series = measured(gas, tau, energy, energy_error, velocities);
  const std::size_t samples = series.tau.size();
  gsl::report_errors();

  gsl_multifit_nlinear_fdf problem{};
  problem.f = residuals;
  problem.n = samples;
  problem.p = 1;
  problem.params = &series;
  auto parameters = gsl_multifit_nlinear_default_parameters();
  parameters.h_df = 1e-5;  // energies carry errors of 1e-9: a step well above their root
  const gsl::Owned<gsl_multifit_nlinear_workspace, gsl_multifit_nlinear_free> fit(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, samples, 1));
  const gsl::Owned<gsl_vector, gsl_vector_free> start(gsl_vector_alloc(1));
  gsl_vector_set(start.get(), 0, std::log(cutoff_b));
  const int begun = gsl_multifit_nlinear_init(start.get(), &problem, fit.get());
  series.caught.rethrow();
  gsl::check(begun, "fit of b");
  int reason = 0;
  const int status = gsl_multifit_nlinear_driver(
      most_iterations, step_tolerance, gradient_tolerance, 0, nullptr, nullptr, &reason, fit.get());
  series.caught.rethrow();
  // GSL reports a failure if no step from the start improves the fit; here the start was right.
  if (reason != GSL_ENOPROG) gsl::check(status, "fit of b");

  const gsl::Owned<gsl_matrix, gsl_matrix_free> covariance(gsl_matrix_alloc(1, 1));
  gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(fit.get()), 0, covariance.get());
  double chi_squared = 0;
  gsl_blas_ddot(gsl_multifit_nlinear_residual(fit.get()), gsl_multifit_nlinear_residual(fit.get()),
                &chi_squared);
  chi_squared /= static_cast<double>(samples - 1);

  const double b = std::exp(gsl_vector_get(gsl_multifit_nlinear_position(fit.get()), 0));
  const bool weighted = !energy_error.empty();
  const double variance = gsl_matrix_get(covariance.get(), 0, 0) * (weighted ? 1 : chi_squared);
  return {
      .b = b,
      .standard_error = b * std::sqrt(variance),
      .chi_squared_per_sample = weighted ? chi_squared : std::numeric_limits<double>::quiet_NaN()};
}

}  // namespace haff::analysis
