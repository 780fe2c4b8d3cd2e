// SPDX-License-Identifier: GPL-3.0-or-later

// The energy equation against an independent solution (to the digits given there), the paper's
// crossover times, and its own limits; the fit of b against series made with a known b.
#include "analysis/theory/energy_equation.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include "analysis/theory/cooling.hpp"
#include "analysis/theory/enskog_boltzmann.hpp"
#include "support/relative.hpp"

using haff::tests::off;
using namespace haff::analysis;
using doctest::Approx;

TEST_CASE("energy equation: ln E at n = 0.40 with b = 0.30") {
  constexpr double digits = 5e-5;  // half of the last digit given
  const auto strong = energy_equation({.e = 0.80, .n = 0.40}, std::vector{10.0, 20.0});
  CHECK(std::abs(std::log(strong[0].energy) + 1.1727) < digits);
  CHECK(std::abs(std::log(strong[1].energy) + 2.3197) < digits);
  const auto weak = energy_equation({.e = 0.90, .n = 0.40}, std::vector{50.0, 100.0});
  CHECK(std::abs(std::log(weak[0].energy) + 3.0994) < digits);
  CHECK(std::abs(std::log(weak[1].energy) + 6.0741) < digits);
}

TEST_CASE("energy equation: tau_c at n = 0.40 with b = 0.30") {
  // The independent solution has one digit after the point.
  const std::map<double, double> known = {{0.80, 58.6}, {0.85, 82.5}, {0.90, 133.9}, {0.95, 303.9}};
  for (const auto& [e, tau] : known) {
    CHECK(std::abs(energy_equation_tau_c({.e = e, .n = 0.40}) - tau) < 0.06);
  }
}

TEST_CASE("energy equation: tau_c is where the solution is twice Haff's") {
  for (const int d : {2, 3}) {
    const Gas gas{.e = 0.85, .n = 0.2, .d = d};
    const double crossover = energy_equation_tau_c(gas);
    const auto there = energy_equation(gas, std::vector{crossover}).front();
    CHECK(off(there.energy, 2 * there.haff) < 1e-8);  // from a step of 1e-8 in tau
    CHECK(off(there.haff, haff_temperature(crossover, gas.e, d) * d / 2) < 1e-13);
  }
}

TEST_CASE("energy equation: gamma_ratio is the solution's own logarithmic slope") {
  const Gas gas{.e = 0.85, .n = 0.4};
  const double h = 1e-3;
  const auto p = energy_equation(gas, std::vector{30 - h, 30.0, 30 + h});
  const double slope = -std::log(p[2].energy / p[0].energy) / (2 * h) / (2 * gamma0(gas.e));
  CHECK(p[1].gamma_ratio == Approx(slope).epsilon(1e-7));
  // It also follows from half the trace of the correlations over E.
  CHECK(p[1].gamma_ratio ==
        Approx(1 - 0.5 * correlation_trace(gas, 30) / p[1].energy).epsilon(1e-8));
}

TEST_CASE("energy equation: it starts with Haff's law, and keeps it without correlations") {
  const Gas gas{.e = 0.8, .n = 0.4};
  const auto start = energy_equation(gas, std::vector{0.0}).front();
  CHECK(start.energy == 1);
  CHECK(start.gamma_ratio == 1);
  const auto far = energy_equation(gas, std::vector{50.0}, 1e-4).front();  // trace ~ b^3
  CHECK(off(far.energy, far.haff) < 1e-6);
}

TEST_CASE("energy equation: the times asked for do not change the solution") {
  const Gas gas{.e = 0.9, .n = 0.4};
  std::vector<double> fine;
  for (int k = 0; k <= 1500; ++k) fine.push_back(0.1 * k);
  CHECK(energy_equation(gas, fine).back().energy ==
        Approx(energy_equation(gas, std::vector{150.0}).front().energy).epsilon(1e-9));
}

TEST_CASE("energy equation: an elastic gas and times out of order are refused") {
  CHECK_THROWS_AS(energy_equation({.e = 1}, std::vector{1.0}), std::invalid_argument);
  CHECK_THROWS_AS(energy_equation({.e = 0.8}, std::vector{2.0, 1.0}), std::invalid_argument);
  CHECK_THROWS_AS(energy_equation({.e = 0.8}, std::vector{-1.0}), std::invalid_argument);
}

namespace {

struct Series {
  std::vector<double> tau, energy, error;
};

// E(tau) of the theory with b, times an alternating disturbance of this relative size.
Series series(const Gas& gas, double b, double disturbance) {
  Series s;
  for (int k = 0; k <= 60; ++k) s.tau.push_back(k);
  for (const auto& p : energy_equation(gas, s.tau, b)) {
    const double sign = s.energy.size() % 2 == 0 ? 1 : -1;
    s.energy.push_back(p.energy * (1 + sign * disturbance));
    s.error.push_back(p.energy * disturbance);
  }
  return s;
}

}  // namespace

TEST_CASE("energy equation: a fit finds the b that made the series") {
  const Gas gas{.e = 0.8, .n = 0.4};
  for (const double b : {0.25, 0.30, 0.36}) {
    const Series exact = series(gas, b, 0);
    const CutoffFit fit = fit_cutoff(gas, exact.tau, exact.energy);
    CHECK(off(fit.b, b) < 1e-6);
    CHECK(std::isnan(fit.chi_squared_per_sample));
  }
}

TEST_CASE("energy equation: a fit to values with errors states its own error") {
  const Gas gas{.e = 0.8, .n = 0.4};
  const Series noisy = series(gas, 0.30, 1e-3);
  const CutoffFit fit = fit_cutoff(gas, noisy.tau, noisy.energy, noisy.error);
  CHECK(std::abs(fit.b - 0.30) < 3 * fit.standard_error);
  CHECK(fit.standard_error > 0);
  CHECK(fit.standard_error < 1e-3);
  // Every residual is one standard error by construction.
  CHECK(fit.chi_squared_per_sample == Approx(1).epsilon(0.05));
}

TEST_CASE("energy equation: a fit to nothing is refused") {
  const Gas gas{.e = 0.8, .n = 0.4};
  CHECK_THROWS_AS(fit_cutoff(gas, std::vector{0.0, 1.0}, std::vector{1.0}), std::invalid_argument);
  CHECK_THROWS_AS(fit_cutoff(gas, std::vector{0.0, 1.0}, std::vector{1.0, 0.9}),
                  std::invalid_argument);
  CHECK_THROWS_AS(fit_cutoff(gas, std::vector{1.0, 2.0}, std::vector{1.0, -0.9}),
                  std::invalid_argument);
}

TEST_CASE("energy equation: a dilute gas loses energy as in Enskog-Boltzmann theory") {
  // Tr G^+ vanishes with n: at 10^-5 it is less than 10^-7 of the energy.
  const Gas dilute{.e = 0.85, .n = 1e-5};
  const auto points =
      energy_equation(dilute, std::vector{1.0, 5.0, 20.0}, cutoff_b, Velocities::enskog_boltzmann);
  for (const EnergyPoint& point : points)
    CHECK(point.gamma_ratio ==
          Approx(boltzmann_gamma_ratio(boltzmann_a2(point.tau, dilute.e))).epsilon(1e-6));
}

TEST_CASE("energy equation: energy, decay rate and tau_c belong to one solution for either f") {
  const Gas gas{.e = 0.85, .n = 0.4};
  constexpr double h = 1e-3;
  const auto points = energy_equation(gas, std::vector{30 - h, 30.0, 30 + h}, cutoff_b,
                                      Velocities::enskog_boltzmann);
  const double slope = std::log(points[0].energy / points[2].energy) / (2 * h);
  CHECK(points[1].gamma_ratio == Approx(slope / (2 * gamma0(gas.e))).epsilon(1e-6));
  const double crossover = energy_equation_tau_c(gas, cutoff_b, Velocities::enskog_boltzmann);
  const auto there =
      energy_equation(gas, std::vector{crossover}, cutoff_b, Velocities::enskog_boltzmann);
  CHECK(off(there[0].energy, 2 * there[0].haff) < 1e-8);
  CHECK(crossover < energy_equation_tau_c(gas));  // f < 1: energy is lost more slowly
}

TEST_CASE("energy equation: b is recovered with the f from which the energies were made") {
  const Gas gas{.e = 0.85, .n = 0.1};
  std::vector<double> tau, energy;
  for (int k = 1; k <= 80; ++k) tau.push_back(k);
  for (const EnergyPoint& point : energy_equation(gas, tau, 0.35, Velocities::enskog_boltzmann))
    energy.push_back(point.energy);
  CHECK(fit_cutoff(gas, tau, energy, {}, Velocities::enskog_boltzmann).b ==
        Approx(0.35).epsilon(1e-6));
  CHECK(fit_cutoff(gas, tau, energy).b > 0.38);  // f = 1 attributes the effect of f to correlations
}
