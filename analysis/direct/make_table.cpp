// The program that made enskog_boltzmann.csv, in some eight minutes of CPU time:
//   cmake --build --preset release --target make_table
//   build/release/analysis/make_table > analysis/direct/enskog_boltzmann.csv
// The same bits come out on every machine: no step takes more than + - x / and square roots.
#include <cmath>
#include <cstdio>
#include <vector>

#include "analysis/direct/direct_simulation.hpp"

using namespace haff::analysis;

namespace {

constexpr SimulationSize size{.particles = 100'000, .realizations = 64, .seed = 1};

// By then a_2 is within 10^-5 of where it stays: it relaxes as exp(-tau/1.9).
constexpr double plateau_from = 15;

std::vector<double> times() {
  std::vector<double> tau;
  for (int half = 0; half < 20; ++half) tau.push_back(0.5 * half);
  for (int whole = 10; whole <= 35; ++whole) tau.push_back(whole);
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

  const std::vector<double> tau = times();
  for (const int d : {3, 2}) {
    for (const double e : {0.7, 0.8, 0.85, 0.865, 0.9, 0.95, 0.98, 1.0}) {
      const auto all = direct_realizations({.law = ConstantRestitution{e}, .d = d}, tau, size);
      const auto means = direct_means(all);
      std::size_t first = 0;
      for (std::size_t k = 0; k < tau.size(); ++k) {
        if (tau[k] >= plateau_from) {
          first = k;
          break;
        }
        char text[32];
        std::snprintf(text, sizeof text, "%g", tau[k]);
        print(d, e, text, means[k]);
      }
      print(d, e, "inf", direct_plateau(all, first));
      std::fflush(stdout);
    }
  }
}
