// What single precision gains and what it shifts, beside double.
//
//   precision_benchmark rates --N 4000 --n 0.4 --e 0.8 --rounds 9
//   precision_benchmark shifts --N 4000 --seeds 1200
//
// Rates are measured in turn, by CPU time. Shifts are differences of what both engines make of the
// same initial states at e = 0.8, n = 0.4.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "analysis/cooling.hpp"
#include "analysis/correlations.hpp"
#include "analysis/moments.hpp"
#include "analysis/velocity_correlations.hpp"
#include "engine/initial.hpp"
#include "engine/simulation.hpp"
#include "tests/benchmark/precision/simulation.hpp"

using namespace haff;

namespace {

double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

engine::State equilibrated(double n, std::uint32_t particles, std::uint64_t seed, double tau) {
  engine::Simulation gas({.restitution = 1}, engine::initial_state(n, particles, seed));
  gas.run_to(engine::collisions_at(tau, particles));
  return engine::restarted(gas.state());
}

double energy(const auto& gas) {
  return std::ldexp(1.5 * analysis::moments(gas.velocities()).temperature, -2 * gas.exponent());
}

// Collisions a second; prints how well the physics holds.
double rate(auto& gas, const char* precision, double tau, std::uint32_t particles, bool report) {
  const double before = energy(gas);
  const double begin = cpu_seconds();
  gas.run_to(engine::collisions_at(tau, particles));
  const double seconds = cpu_seconds() - begin;
  const engine::Events events = gas.events();
  const engine::Invariants held = gas.invariants();
  if (report)
    std::printf(
        "%s  %5.1f bytes a particle, overlap %.2g, energy mismatch %.2g, change of energy %.2g, "
        "events in the past %lld, crossings %.4f\n",
        precision, static_cast<double>(gas.memory()) / particles, 1 - std::sqrt(held.closest2),
        held.energy_mismatch, (energy(gas) - before) / before,
        static_cast<long long>(held.past_events),
        static_cast<double>(events.crossings) / static_cast<double>(events.collisions));
  return static_cast<double>(events.collisions) / seconds;
}

void compare_rates(std::uint32_t particles, double n, double e, double tau, int rounds) {
  std::vector<double> in_double, in_single, ratio;
  for (int round = 0; round < rounds; ++round) {
    const auto seed = static_cast<std::uint64_t>(round) + 1;
    const engine::State start = equilibrated(n, particles, seed, 20);
    for (const int turn : {round % 2, 1 - round % 2})
      if (turn == 0) {
        engine::Simulation gas({.restitution = e}, start);
        in_double.push_back(rate(gas, "double", tau, particles, round == 0));
      } else {
        single::Simulation gas(e, start);
        in_single.push_back(rate(gas, "single", tau, particles, round == 0));
      }
    ratio.push_back(in_single.back() / in_double.back());
  }
  std::printf(
      "N = %u, n = %g, e = %g: double %.3f, single %.3f x 10^6 collisions/s, ratio %.3f (medians "
      "of %d pairs)\n",
      particles, n, e, 1e-6 * median(in_double), 1e-6 * median(in_single), median(ratio), rounds);
}

constexpr std::array<const char*, 10> quantities{"ln T/T0, tau = 10",
                                                 "ln T/T0, tau = 50",
                                                 "a2, tau = 5 ... 15",
                                                 "a3, tau = 5 ... 15",
                                                 "a2, tau = 40 ... 60",
                                                 "gamma/gamma0, tau = 8 ... 12",
                                                 "gamma/gamma0, tau = 48 ... 52",
                                                 "tau_c",
                                                 "p/(nT), tau = 2 ... 15",
                                                 "G_parallel(5), tau = 50"};
using Values = std::array<double, quantities.size()>;

double mean(const std::vector<double>& series, int from, int to) {
  double sum = 0;
  for (int tau = from; tau <= to; ++tau) sum += series[static_cast<std::size_t>(tau)];
  return sum / (to - from + 1);
}

double g_parallel_at_5(const auto& gas, double n, double box) {
  const auto g = analysis::velocity_correlations(
      gas.positions(), gas.velocities(), box, analysis::cutoff_wavenumber(n, analysis::cutoff_b));
  std::size_t k = 1;
  while (g.r[k] < 5) ++k;
  const double there = (5 - g.r[k - 1]) / (g.r[k] - g.r[k - 1]);
  return std::ldexp(std::lerp(g.parallel[k - 1], g.parallel[k], there), -2 * gas.exponent());
}

Values measured(auto& gas, double n, double e, std::uint32_t particles, int tau_max) {
  const double box = std::cbrt(particles / n);
  std::vector<double> taus, temperature, a2, a3, decay{0}, pressure{0};
  double g = 0, time = gas.time();
  gas.take_tally();
  for (int tau = 0; tau <= tau_max; ++tau) {
    gas.run_to(engine::collisions_at(tau, particles));
    const auto moments = analysis::moments(gas.velocities());
    taus.push_back(tau);
    temperature.push_back(std::ldexp(moments.temperature, -2 * gas.exponent()));
    a2.push_back(moments.laguerre[2]);
    a3.push_back(moments.laguerre[3]);
    if (tau > 0) {
      const double before = temperature[temperature.size() - 2];
      const double between = 0.5 * (before + temperature.back());
      decay.push_back(analysis::gamma_ratio(before, temperature.back(), 1, e));
      pressure.push_back(
          analysis::pressure(n, between, gas.take_tally().virial, particles, gas.time() - time) /
          (n * between));
      time = gas.time();
    }
    if (tau == 50) g = g_parallel_at_5(gas, n, box);
  }
  return {std::log(temperature[10] / temperature[0]),
          std::log(temperature[50] / temperature[0]),
          mean(a2, 5, 15),
          mean(a3, 5, 15),
          mean(a2, 40, 60),
          mean(decay, 9, 12),
          mean(decay, 49, 52),
          analysis::tau_c(taus, temperature, e).value_or(NAN),
          mean(pressure, 2, 15),
          g};
}

void compare_results(std::uint32_t particles, std::uint64_t first, int seeds) {
  constexpr double n = 0.4, e = 0.8;
  constexpr int tau_max = 90;  // beyond tau_c
  std::array<std::vector<double>, quantities.size()> shift;
  for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(seeds); ++seed) {
    const engine::State start = equilibrated(n, particles, seed, 50);
    engine::Simulation in_double({.restitution = e}, start);
    single::Simulation in_single(e, start);
    const Values one = measured(in_single, n, e, particles, tau_max);
    const Values other = measured(in_double, n, e, particles, tau_max);
    for (std::size_t q = 0; q < quantities.size(); ++q)
      if (std::isfinite(one[q] - other[q])) shift[q].push_back(one[q] - other[q]);
  }
  std::printf("N = %u: single less double, its error, how many of these it is, seeds\n", particles);
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    const auto count = static_cast<double>(shift[q].size());
    double sum = 0, squares = 0;
    for (const double x : shift[q]) sum += x;
    for (const double x : shift[q]) squares += (x - sum / count) * (x - sum / count);
    const double error = std::sqrt(squares / (count - 1) / count);
    std::printf("%-32s %+.2e  %.1e  %+.1f  %.0f\n", quantities[q], sum / count, error,
                sum / count / error, count);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::uint32_t particles = 4000;
  double n = 0.4, e = 1, tau = 20;
  int rounds = 9, seeds = 100;
  std::uint64_t first = 1;
  CLI::App app("Single precision beside double");
  app.require_subcommand(1);
  auto* const rates = app.add_subcommand("rates", "collisions a second, memory, invariants");
  auto* const shifts = app.add_subcommand("shifts", "of what is measured at e = 0.8, n = 0.4");
  for (auto* const each : {rates, shifts})
    each->add_option("--N", particles, "particles")->capture_default_str();
  rates->add_option("--n", n, "number density")->capture_default_str();
  rates->add_option("--e", e, "restitution coefficient")->capture_default_str();
  rates->add_option("--tau", tau, "a multiple of 10")->capture_default_str();
  rates->add_option("--rounds", rounds, "pairs of runs")->capture_default_str();
  shifts->add_option("--first", first, "seed")->capture_default_str();
  shifts->add_option("--seeds", seeds, "realizations")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  if (*rates)
    compare_rates(particles, n, e, tau, rounds);
  else
    compare_results(particles, first, seeds);
  return 0;
}
