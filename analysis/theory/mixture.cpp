// SPDX-License-Identifier: GPL-3.0-or-later

#include "analysis/theory/mixture.hpp"

#include <gsl/gsl_roots.h>

#include <array>
#include <cmath>
#include <numbers>

#include "analysis/gsl.hpp"

namespace haff::analysis {
namespace {

struct Species {
  double fraction, diameter, mass;
};

std::array<Species, 2> species_of(const BinaryMixture& gas) {
  return {{{1 - gas.fraction, 1, 1}, {gas.fraction, gas.diameter_ratio, gas.mass_ratio}}};
}

// sum of x_i sigma_i^power
double moment(const BinaryMixture& gas, int power) {
  double sum = 0;
  for (const Species& one : species_of(gas)) sum += one.fraction * std::pow(one.diameter, power);
  return sum;
}

// T_1/T_2 is searched from 1/widest to widest, by bisection of its logarithm.
constexpr double widest = 1e6;
constexpr double precision = 1e-12;  // of that logarithm

}  // namespace

double packing_fraction(const BinaryMixture& gas) {
  return std::numbers::pi / (gas.d == 2 ? 4 : 6) * gas.n * moment(gas, gas.d);
}

double contact_value(const BinaryMixture& gas, int i, int j) {
  const double phi = packing_fraction(gas);
  if (!(phi >= 0 && phi < 1)) throw std::invalid_argument("a packing fraction lies from 0 to 1");
  const auto species = species_of(gas);
  const double a = species.at(static_cast<std::size_t>(i - 1)).diameter;
  const double b = species.at(static_cast<std::size_t>(j - 1)).diameter;
  const double y = 2 * a * b / (a + b) * moment(gas, gas.d - 1) / moment(gas, gas.d);
  const double free = 1 - phi;
  if (gas.d == 2) return 1 / free + 9.0 / 16 * phi * y / (free * free);
  return 1 / free + 1.5 * phi * y / (free * free) + 0.5 * phi * phi * y * y / (free * free * free);
}

double cooling_rate(const BinaryMixture& gas, int i, double temperature_1, double temperature_2) {
  const auto species = species_of(gas);
  const std::array temperature{temperature_1, temperature_2};
  const auto speed2 = [&](std::size_t k) { return 2 * temperature.at(k) / species.at(k).mass; };
  const auto own = static_cast<std::size_t>(i - 1);
  double rate = 0;
  for (std::size_t other = 0; other < 2; ++other) {
    const double mu = species[other].mass / (species[own].mass + species[other].mass);
    const double contact = 0.5 * (species[own].diameter + species[other].diameter);
    const double chi = contact_value(gas, i, static_cast<int>(other) + 1);
    const double target = gas.d == 2 ? contact : contact * contact;
    rate += gas.n * species[other].fraction * chi * target * mu * (1 + gas.e) *
            std::sqrt(speed2(own) + speed2(other)) *
            (1 - 0.5 * mu * (1 + gas.e) * (1 + speed2(other) / speed2(own)));
  }
  return (gas.d == 2 ? 2.0 : 8.0 / 3) * std::sqrt(std::numbers::pi) * rate;
}

namespace {

// The ratio T_1/T_2 at which a function of its logarithm is zero.
template <class Difference>
double ratio_of(const Difference& difference) {
  gsl::report_errors();
  gsl::Called called(difference);
  gsl_function function = called.view();
  const gsl::Owned<gsl_root_fsolver, gsl_root_fsolver_free> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent));
  called.check(gsl_root_fsolver_set(solver.get(), &function, -std::log(widest), std::log(widest)),
               "the temperature ratio of a mixture");
  for (int step = 0; step < 200; ++step) {
    called.check(gsl_root_fsolver_iterate(solver.get()), "the temperature ratio of a mixture");
    if (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver.get()),
                               gsl_root_fsolver_x_upper(solver.get()), precision, 0) == GSL_SUCCESS)
      break;
  }
  return std::exp(gsl_root_fsolver_root(solver.get()));
}

}  // namespace

double temperature_ratio(const BinaryMixture& gas) {
  return ratio_of([&](double log_ratio) {
    const double ratio = std::exp(log_ratio);
    return cooling_rate(gas, 1, ratio, 1) - cooling_rate(gas, 2, ratio, 1);
  });
}

double heated_temperature_ratio(const BinaryMixture& gas) {
  return ratio_of([&](double log_ratio) {
    const double ratio = std::exp(log_ratio);
    return cooling_rate(gas, 1, ratio, 1) * ratio - cooling_rate(gas, 2, ratio, 1) / gas.mass_ratio;
  });
}

}  // namespace haff::analysis
