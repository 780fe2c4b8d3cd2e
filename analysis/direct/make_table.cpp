// SPDX-License-Identifier: GPL-3.0-or-later

// The program that made enskog_boltzmann.csv, in some ten minutes of CPU time:
//   cmake --build --preset release --target make_table
//   build/release/analysis/make_table > analysis/direct/enskog_boltzmann.csv
// The same bits come out on every machine: no step takes more than + - x / and square roots.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

#include "analysis/direct/direct_simulation.hpp"

using namespace haff::analysis;

namespace {

// Realizations up to tau = 14, and how many of these go on.
constexpr std::uint32_t realizations = 128, long_ones = 64;
constexpr std::uint32_t particles = 100'000;
constexpr std::uint64_t seed = 1;

// By then a_2 is within 10^-5 of its final value: it relaxes as exp(-tau/1.9).
constexpr double plateau_from = 15, plateau_until = 35;

std::vector<double> times(double end) {
  std::vector<double> tau;
  tau.reserve(20 + static_cast<std::size_t>(end));
  for (int half = 0; half < 20; ++half) tau.push_back(0.5 * half);
  for (double whole = 10; whole <= end; ++whole) tau.push_back(whole);
  return tau;
}

void print(int d, double e, const char* tau, const DirectPoint& point) {
  std::printf("%d,%g,%s", d, e, tau);
  const auto print = [](const Estimate& value) {
    std::printf(",%.6f,%.6f", value.mean, value.standard_error);
  };
  for (int l = 2; l <= highest_laguerre; ++l) print(point.laguerre[static_cast<std::size_t>(l)]);
  print(point.gamma_ratio);
  print(point.rate_ratio);
  std::printf("\n");
}

}  // namespace

int main() {
  std::printf("d,e,tau");
  for (const char* name : {"a2", "a3", "a4", "a5", "a6", "gamma_ratio", "rate_ratio"})
    std::printf(",%s,%s_se", name, name);
  std::printf("\n");

  const std::vector<double> transient = times(plateau_from - 1), all = times(plateau_until);
  for (const int d : {3, 2}) {
    for (const double e : {0.7, 0.8, 0.85, 0.865, 0.9, 0.95, 0.98, 1.0}) {
      const HomogeneousGas gas{.law = ConstantRestitution{e}, .d = d};
      DirectRealizations until_then, from_then;
      for (std::uint32_t k = 0; k < realizations; ++k) {
        auto samples = direct_realization(gas, k < long_ones ? all : transient, particles, seed, k);
        if (k < long_ones) from_then.push_back(samples);
        samples.resize(transient.size());
        until_then.push_back(std::move(samples));
      }
      const auto means = direct_means(until_then);
      for (std::size_t k = 0; k < transient.size(); ++k) {
        char text[32];
        std::snprintf(text, sizeof text, "%g", transient[k]);
        print(d, e, text, means[k]);
      }
      print(d, e, "inf", direct_plateau(from_then, transient.size()));
      std::fflush(stdout);
    }
  }
}
