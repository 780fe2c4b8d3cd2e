// SPDX-License-Identifier: GPL-3.0-or-later

// Effects against published physics: the shuffled and the heated gas, and restitution laws.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "analysis/direct/table.hpp"
#include "analysis/observables/moments.hpp"
#include "analysis/statistics/statistics.hpp"
#include "analysis/theory/cooling.hpp"
#include "analysis/theory/enskog.hpp"
#include "analysis/theory/enskog_boltzmann.hpp"
#include "engine/initial.hpp"
#include "engine/simulation.hpp"

using namespace haff;

namespace {

engine::State equilibrated(std::uint32_t particles, double n, std::uint64_t seed = 1) {
  engine::Simulation melting({.restitution = 1}, engine::initial_state(n, particles, seed));
  melting.run_to(engine::collisions_at(50, particles));
  return engine::restarted(melting.state());
}

analysis::Moments measured(const engine::Simulation& gas) {
  analysis::Moments moments = analysis::moments(gas.velocities());
  moments.temperature = std::ldexp(moments.temperature, -2 * gas.exponent());
  return moments;
}

struct Series {
  std::vector<double> tau, time, temperature, a2;
};

Series run(const engine::Model& model, const engine::State& start, double from, double to,
           double every) {
  engine::Simulation gas(model, start);
  Series series;
  for (double tau = from; tau <= to; tau += every) {
    gas.run_to(engine::collisions_at(tau, gas.particles()));
    const analysis::Moments now = measured(gas);
    series.tau.push_back(tau);
    series.time.push_back(gas.time());
    series.temperature.push_back(now.temperature);
    series.a2.push_back(now.laguerre[2]);
  }
  return series;
}

// gamma/gamma_0, averaged over a whole series.
double gamma_ratio(const Series& series, double e) {
  return analysis::gamma_ratio(series.temperature.front(), series.temperature.back(),
                               series.tau.back() - series.tau.front(), e);
}

// The slope of ln y against ln x.
double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  const auto count = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += std::log(x[i]) / count;
    mean_y += std::log(y[i]) / count;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double from_mean = std::log(x[i]) - mean_x;
    xx += from_mean * from_mean;
    xy += from_mean * (std::log(y[i]) - mean_y);
  }
  return xy / xx;
}

}  // namespace

// The argument of R. Kawahara and H. Nakanishi, cond-mat/0309130, in 3-d: without correlations a
// gas stays at the fixed point of the Enskog-Boltzmann equation, a_2 = -0.0170 by direct simulation
// (-A/B = -0.0153 is first order in a_2). At n = 0.4 a shuffle leaves pairs near contact, which
// collide again without the weight v_n that other colliding pairs have: a_2 falls short, and less
// energy is lost in a collision. With positions equilibrated in between, gamma/gamma_0 is 0.992
// there; the loss is highest in the first tenth of an interval.
TEST_CASE("effects: a shuffled gas keeps the a2 of the Enskog-Boltzmann equation") {
  constexpr double e = 0.85;
  constexpr std::uint64_t seeds = 10;
  const auto plateau = analysis::tabulated("a2", e)->plateau;
  const auto decay = analysis::tabulated("gamma_ratio", e)->plateau;
  for (const double n : {0.05, 0.4}) {
    CAPTURE(n);
    std::vector<double> a2s, ratios;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const Series series =
          run({.restitution = e, .effects = {{"shuffle", {{"every", 1}}}}, .seed = seed},
              equilibrated(32'000, n, seed), 10, 110, 1);
      a2s.push_back(analysis::estimate(series.a2).mean);
      ratios.push_back(gamma_ratio(series, e));
    }
    const auto a2 = analysis::estimate(a2s), ratio = analysis::estimate(ratios);
    MESSAGE("n = " << n << ": a2 = " << a2.mean << " +- " << a2.standard_error
                   << ", direct simulation " << plateau.value << "; gamma/gamma_0 = " << ratio.mean
                   << " +- " << ratio.standard_error << ", direct simulation " << decay.value);
    // The shortfalls are measured values; theory has no number for them. Four errors of ten seeds
    // are a false alarm once in 300 (Student's t with 9 degrees). If the shuffle had no effect, a_2
    // would be back at zero and gamma would fall.
    const double shortfall = n < 0.1 ? 0.064 : 0.110, expected_ratio = n < 0.1 ? 0.9938 : 0.9794;
    CHECK(a2.standard_error < 4e-4);
    CHECK(std::abs(a2.mean - (1 - shortfall) * plateau.value) < 4 * a2.standard_error);
    CHECK(std::abs(ratio.mean - expected_ratio) < 4 * ratio.standard_error);
  }
}

// T. P. C. van Noije and M. H. Ernst, Granular Matter 1, 57 (1998), cond-mat/9803042. Errors are
// the scatter of six seeds: T is correlated over some six collisions per particle, and 60 are
// sampled.
TEST_CASE("effects: a heated gas reaches its a2 and temperature") {
  constexpr double n = 0.05, rate = 0.05;
  constexpr std::uint32_t particles = 16'000;
  constexpr std::uint64_t seeds = 6;
  std::vector<engine::State> starts;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed)
    starts.push_back(equilibrated(particles, n, seed));
  for (const double e : {0.6, 0.8}) {
    CAPTURE(e);
    std::vector<double> a2s, temperatures;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const Series series =
          run({.restitution = e, .effects = {{"thermostat", {{"rate", rate}}}}, .seed = seed},
              starts[seed - 1], 20, 80, 1);
      a2s.push_back(analysis::estimate(series.a2).mean);
      temperatures.push_back(analysis::estimate(series.temperature).mean);
    }
    const auto a2 = analysis::estimate(a2s);
    const double theory = analysis::heated_a2(e);
    MESSAGE("e = " << e << ": a2 = " << a2.mean << " +- " << a2.standard_error << ", theory "
                   << theory);
    // Five errors of six seeds are a false alarm once in 250; another 20 % are allowed for a theory
    // that is linear in a_2: at e = 0.6 the gas has 0.0150.
    CHECK(std::abs(a2.mean - theory) < 5 * a2.standard_error + 0.2 * std::abs(theory));
    // The energy given is the energy lost: rate = 2 gamma_0 omega (3/2) T with Enskog's omega. This
    // is good to some 1 % here, since velocities of partners are weakly correlated; T ~ rate^(2/3).
    const double omega = analysis::transport(n, 1).collision_rate;
    const double expected = std::pow(rate / (3 * analysis::gamma0(e) * omega), 2.0 / 3);
    const auto temperature = analysis::estimate(temperatures);
    MESSAGE("T = " << temperature.mean << " +- " << temperature.standard_error << ", theory "
                   << expected);
    CHECK(std::abs(temperature.mean / expected - 1) < 0.015);
  }
}

// T. Schwager and T. Poeschel, PRE 57, 650 (1998); N. V. Brilliantov and T. Poeschel, PRE 61, 5573
// (2000): T ~ t^(-5/3) for weak dissipation and long times. The slope of ln T against ln t is
// fitted where 10^-3 > T/T_0 > 10^-6, over 2.5 decades of t; earlier, T depends on its start as (1
// + t/t_0)^(-5/3). The correction in A at these speeds, T^(1/10), changes the slope by some 0.005
// (-1.671 measured), and the noise of 4000 particles by about 0.002; with constant e it would be
// -2.
TEST_CASE("a viscoelastic gas cools as t^(-5/3)") {
  constexpr double tolerance = 0.02;
  const Series all =
      run({.law = {"viscoelastic", {{"A", 0.05}}}}, equilibrated(4000, 0.1), 5, 900, 5);
  std::vector<double> time, temperature;
  for (std::size_t i = 0; i < all.time.size(); ++i) {
    const double cooled = all.temperature[i] * 1.5;
    if (cooled > 1e-3 || cooled < 1e-6) continue;
    time.push_back(all.time[i]);
    temperature.push_back(all.temperature[i]);
  }
  const double slope = exponent(time, temperature);
  MESSAGE("T ~ t^" << slope << " over " << time.size() << " samples, t = " << time.front() << " to "
                   << time.back());
  CHECK(time.size() > 50);
  CHECK(std::abs(slope + 5.0 / 3) < tolerance);
}

// S. Luding and S. McNamara, Granular Matter 1, 113 (1998), cond-mat/9810009: a t_c far below the
// time between collisions affects collapse alone. A sphere has omega collisions in a unit of time,
// so a fraction 2 omega t_c of the collisions come within t_c of a partner's last one and lose no
// energy. This fraction of 2 gamma_0 tau, while omega falls as exp(-gamma_0 tau), adds up to 4
// omega_0 t_c, for any e. Here omega_0 = 4.2 and t_c = 10^-4, 1/2400 of the time between
// collisions: 0.0017 in ln T, of 2.4 that are lost. Two gases from one state soon become
// independent realizations. The mean of their differences over four starts has a standard error of
// 0.003 in ln T at tau = 20 (as many collisions, each with a loss that scatters by its mean) and of
// sqrt(8/(15 N))/sqrt(2) = 0.003 in a2; four of these are allowed. Measured: 0.0006 at tau = 5, at
// most 0.005 up to 20.
TEST_CASE("the TC model leaves the early stage untouched") {
  constexpr double e = 0.8, n = 0.4, t_c = 1e-4, omega = 4.2;
  constexpr std::uint32_t particles = 32'000;
  constexpr int starts = 4;
  std::vector<double> ln_temperature(20), a2(20);
  for (std::uint64_t seed = 1; seed <= starts; ++seed) {
    const engine::State start = equilibrated(particles, n, seed);
    const Series plain = run({.restitution = e}, start, 1, 20, 1);
    const Series softened = run({.restitution = e, .law = {"tc", {{"t_c", t_c}}}}, start, 1, 20, 1);
    for (std::size_t k = 0; k < 20; ++k) {
      ln_temperature[k] += std::log(softened.temperature[k] / plain.temperature[k]) / starts;
      a2[k] += (softened.a2[k] - plain.a2[k]) / starts;
    }
  }
  for (std::size_t k = 0; k < 20; ++k) {
    CAPTURE(k);
    MESSAGE("tau = " << k + 1 << ": ln T differs by " << ln_temperature[k] << ", a2 by " << a2[k]);
    CHECK(std::abs(ln_temperature[k]) < 4 * omega * t_c + 4 * 0.003);
    CHECK(std::abs(a2[k]) < 4 * 0.003);
  }
}

// Kinetic theory: in a Maxwellian gas the normal components of relative velocities are Gaussian
// with variance 2T, and pairs collide in proportion to these components, so that normal speeds of
// colliding pairs are distributed as v exp(-v^2/(4T)). The loss is proportional to v^2. Relative to
// the loss at constant e, speeds above v_c contribute
//   int_x^inf u exp(-u) du = (1 + x) exp(-x),   x = v_c^2/(4T).
// At e = 0.99 the gas stays Maxwellian (a_2 = -0.0025), and T follows from d ln T/dtau = -2 gamma_0
// (1 + x) exp(-x). 8 10^5 collisions, of which one in 30 counts at v_c = 3, give the loss to 0.5 %;
// four times that is allowed. Measured: within 1 %.
TEST_CASE("an elastic threshold reduces the loss as in kinetic theory") {
  constexpr double e = 0.99, n = 0.05, last = 50, tolerance = 0.02;
  const engine::State start = equilibrated(32'000, n);
  for (const double speed : {0.0, 1.0, 2.0, 3.0}) {
    CAPTURE(speed);
    engine::Model model{.restitution = e};
    if (speed > 0) model.law = {"threshold", {{"speed", speed}}};
    engine::Simulation gas(model, start);
    const double before = measured(gas).temperature;
    gas.run_to(engine::collisions_at(last, gas.particles()));
    const double lost = std::log(before / measured(gas).temperature);

    double expected = 0;
    constexpr int steps = 1000;
    for (int step = 0; step < steps; ++step) {
      const double x = speed * speed / (4 * before * std::exp(-expected));
      expected += 2 * analysis::gamma0(e) * (1 + x) * std::exp(-x) * last / steps;
    }
    MESSAGE("v_c = " << speed << ": ln T falls by " << lost << ", theory " << expected);
    CHECK(lost == doctest::Approx(expected).epsilon(tolerance));
  }
}
