// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/measurement.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "analysis/observables/moments.hpp"
#include "analysis/theory/cooling.hpp"
#include "campaign/job/gas.hpp"

using namespace haff;
using namespace haff::campaign;

TEST_CASE("measurement: the first sample has a temperature and no rates") {
  auto gas = campaign::gas(job(0.8));
  const auto first = measure(gas, job(0.8), 0, {});
  CHECK(first.time == 0);
  CHECK(*first.temperature == doctest::Approx(2.0 / 3).epsilon(1e-14));
  CHECK(first.a2);
  CHECK_FALSE(first.gamma_ratio);
  CHECK_FALSE(first.collision_rate);
  CHECK_FALSE(first.pressure);
}

TEST_CASE("measurement: rates follow from two samples") {
  const auto physics = job(0.8);
  auto gas = campaign::gas(physics);
  const auto first = measure(gas, physics, 0, {});
  gas.run_to(engine::collisions_at(2, physics.particles));
  const auto second = measure(gas, physics, 2, {&first, 1});
  CHECK(*second.gamma_ratio == doctest::Approx(std::log(*first.temperature / *second.temperature) /
                                               (2 * analysis::gamma0(0.8) * 2)));
  CHECK(*second.collision_rate == doctest::Approx(2 / second.time));
  // The pressure is between that of the ideal gas and a generous upper bound.
  CHECK(*second.pressure > 0.4 * *second.temperature);
  CHECK(*second.pressure < 10 * 0.4 * *first.temperature);
}

TEST_CASE("measurement: an elastic gas has no gamma_ratio") {
  const auto physics = job(1);
  auto gas = campaign::gas(physics);
  const auto first = measure(gas, physics, 0, {});
  gas.run_to(engine::collisions_at(1, physics.particles));
  const auto second = measure(gas, physics, 1, {&first, 1});
  CHECK_FALSE(second.gamma_ratio);
  CHECK(second.collision_rate);
}

TEST_CASE("measurement: observables that are not listed are not measured") {
  auto physics = job(0.8);
  physics.observables = {"temperature"};
  auto gas = campaign::gas(physics);
  const auto sample = measure(gas, physics, 0, {});
  CHECK(sample.temperature);
  CHECK_FALSE(sample.a2);
}

TEST_CASE("measurement: two samples at one instant have no rates between them") {
  auto gas = campaign::gas(job(0.8));
  const auto first = measure(gas, job(0.8), 0, {});
  const auto second = measure(gas, job(0.8), 1e-6, {&first, 1});
  CHECK_FALSE(second.collision_rate);
  CHECK_FALSE(second.pressure);
}

TEST_CASE("measurement: the temperature is in true units, however far the gas has cooled") {
  const auto physics = job(0.5, 108);
  auto gas = campaign::gas(physics);
  gas.run_to(engine::collisions_at(300, physics.particles));
  REQUIRE(gas.exponent() != 0);
  const auto sample = measure(gas, physics, 300, {});
  const double scaled = analysis::moments(gas.velocities()).temperature;
  CHECK(*sample.temperature == scaled * std::exp2(-2 * gas.exponent()));
}

TEST_CASE("measurement: tau_c and its time may lie between two samples") {
  // T = 2/3 exp(-tau/10) is slower than Haff's law at e = 0.8, 2 gamma_0 = 0.12:
  // T/T_Haff = exp(tau/50) = 2 at tau = 50 ln 2 = 34.66. Time is linear in tau here.
  std::vector<schema::Sample> samples;
  for (int tau = 0; tau <= 50; ++tau)
    samples.push_back(
        {.tau = 1.0 * tau, .time = 3.0 * tau, .temperature = 2.0 / 3 * std::exp(-0.1 * tau)});
  const auto found = results(samples, job(0.8));
  CHECK(*found.tau_c == doctest::Approx(50 * std::log(2)).epsilon(1e-12));
  CHECK(*found.time_c == doctest::Approx(150 * std::log(2)).epsilon(1e-12));
}

TEST_CASE("measurement: there is no tau_c before it is reached, nor for an elastic gas") {
  std::vector<schema::Sample> samples;
  for (int tau = 0; tau <= 5; ++tau)
    samples.push_back({.tau = 1.0 * tau, .time = 1.0 * tau, .temperature = 2.0 / 3});
  CHECK_FALSE(results(samples, job(1)).tau_c);
  CHECK_FALSE(results({samples.front()}, job(0.8)).tau_c);
}

TEST_CASE("measurement: a Gaussian gas is in equilibrium, and another is not") {
  const auto physics = job(1, 4000);
  schema::Sample sample{.a2 = 0.0, .a3 = 0.0, .a4 = 0.0};
  CHECK(is_equilibrated(sample, physics));
  sample.a2 = 0.06;  // 5 standard errors, sqrt(8/(15 N)) = 0.0115
  CHECK_FALSE(is_equilibrated(sample, physics));
  sample.a2 = std::nullopt;
  CHECK_FALSE(is_equilibrated(sample, physics));
}

TEST_CASE("measurement: no column depends on the interval between samples") {
  // Values at a moment are the same in every bit; rates over an interval are sums over it. The time
  // average of the pressure is the same from the rows of every tau, every 5 or every 10: the
  // collisional part is a sum, and the error of the kinetic part is of the fourth power of the
  // interval. The trapezoidal rule would be off by 1.9 % and 7.8 %.
  auto physics = job(0.8, 4000);
  // The start is elastic equilibrium: while a lattice melts, no curve is smooth.
  auto elastic = campaign::gas(job(1, 4000));
  elastic.run_to(engine::collisions_at(20, physics.particles));
  const engine::State start = engine::restarted(elastic.state());
  const auto taken = [&](double every) {
    engine::Simulation gas({.restitution = *physics.e}, start);
    std::vector<schema::Sample> rows;
    for (int k = 0; k * every <= 40; ++k) {
      gas.run_to(engine::collisions_at(k * every, physics.particles));
      rows.push_back(measure(gas, physics, k * every, rows));
    }
    return rows;
  };
  const auto fine = taken(1);
  // The mean over the rows of every tau within an interval, weighted by time or by tau.
  const auto mean_of_fine = [&](auto value, auto clock, double from, double to) {
    double sum = 0, length = 0;
    for (std::size_t k = 1; k < fine.size(); ++k) {
      if (fine[k].tau < from + 0.5 || fine[k].tau > to + 0.5) continue;
      const double step = fine[k].*clock - fine[k - 1].*clock;
      sum += *(fine[k].*value) * step;
      length += step;
    }
    return sum / length;
  };
  // Fluctuations between the ends of an interval are not known: per collision and particle, ln T
  // wanders by 0.12 times the scatter of the loss, which is as large as the loss itself in each of
  // N/2 collisions. The mean of a bridge of that walk is within sqrt(interval/12) of it.
  const double walk = 0.12 / std::sqrt(physics.particles / 2.0);
  constexpr double rounding = 1e-12;  // in sums of ten terms, and in logarithms of T
  for (const double every : {5.0, 10.0}) {
    const double tolerance = 4 * walk * std::sqrt(every / 12);  // 0.7 % and 1.0 %
    const auto coarse = taken(every);
    for (std::size_t k = 1; k < coarse.size(); ++k) {
      CAPTURE(every);
      CAPTURE(coarse[k].tau);
      const double from = coarse[k - 1].tau, to = coarse[k].tau;
      const schema::Sample& same = fine[static_cast<std::size_t>(to)];
      CHECK(coarse[k].time == same.time);
      CHECK(*coarse[k].temperature == *same.temperature);
      CHECK(coarse[k].a2 == same.a2);
      using Row = schema::Sample;
      const double rate = mean_of_fine(&Row::collision_rate, &Row::time, from, to);
      CHECK(std::abs(*coarse[k].collision_rate / rate - 1) < rounding);
      const double gamma = mean_of_fine(&Row::gamma_ratio, &Row::tau, from, to);
      CHECK(std::abs(*coarse[k].gamma_ratio - gamma) < rounding);
      const double pressure = mean_of_fine(&Row::pressure, &Row::time, from, to);
      CHECK(std::abs(*coarse[k].pressure / pressure - 1) < tolerance);
    }
  }
}

TEST_CASE("measurement: rough spheres have a temperature of rotation, but no tau_c") {
  auto physics = job(0.8);
  physics.effects = R"({"roughness":{"beta":0.5,"q":0.4}})";
  engine::Simulation gas(model_of(physics), engine::initial_state(0.4, physics.particles, 1));
  const auto first = measure(gas, physics, 0, {});
  CHECK(*first.rotational_temperature == 0);
  gas.run_to(engine::collisions_at(30, physics.particles));
  const auto later = measure(gas, physics, 30, {&first, 1});
  CHECK(*later.rotational_temperature ==
        doctest::Approx(std::ldexp(*gas.rotational_energy(), -2 * gas.exponent()) * 2 / 3));
  CHECK(*later.rotational_temperature > 0.1 * *later.temperature);
  CHECK_FALSE(later.temperature_1);
  CHECK_FALSE(results({first, later}, physics).tau_c);

  auto smooth = campaign::gas(job(0.8));
  CHECK_FALSE(measure(smooth, job(0.8), 0, {}).rotational_temperature);
}

TEST_CASE("measurement: rough disks rotate about one axis") {
  auto physics = job(0.8);
  physics.d = 2;
  physics.effects = R"({"roughness":{"beta":0.5,"q":0.5}})";
  engine::Simulation gas(model_of(physics), engine::initial_state(0.4, physics.particles, 1, 2));
  gas.run_to(engine::collisions_at(10, physics.particles));
  const auto sample = measure(gas, physics, 10, {});
  CHECK(*sample.rotational_temperature ==
        doctest::Approx(std::ldexp(*gas.rotational_energy(), -2 * gas.exponent()) * 2));
}

TEST_CASE("measurement: a mixture has the temperatures of its species, and one of all particles") {
  auto physics = job(1);
  physics.effects = R"({"mixture":{"diameter_ratio":0.5,"fraction":0.3,"mass_ratio":0.1}})";
  const auto model = model_of(physics);
  engine::Simulation gas(model, engine::initial_state(0.4, physics.particles, 1, 3, model.effects));
  gas.run_to(engine::collisions_at(10, physics.particles));
  const auto sample = measure(gas, physics, 10, {});
  CHECK(*sample.temperature == doctest::Approx(2.0 / 3).epsilon(1e-12));
  CHECK(0.7 * *sample.temperature_1 + 0.3 * *sample.temperature_2 ==
        doctest::Approx(*sample.temperature).epsilon(1e-12));
  // 300 particles in equilibrium: four standard errors sqrt(2/900).
  CHECK(std::abs(*sample.temperature_2 * 1.5 - 1) < 4 * std::sqrt(2.0 / 900));
  CHECK(std::abs(*sample.a2) < 4 * analysis::laguerre_noise(2, physics.particles));
}
