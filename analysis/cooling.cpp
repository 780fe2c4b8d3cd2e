#include "analysis/cooling.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace haff::analysis {

double gamma0(double e, int d) {
  return (1 - e * e) / (2 * d);
}

double initial_temperature(int d) {
  return 2.0 / d;
}

double haff_temperature(double tau, double e, int d) {
  return initial_temperature(d) * std::exp(-2 * gamma0(e, d) * tau);
}

double gamma_ratio(double before, double after, double interval, double e, int d) {
  const double rate = gamma0(e, d);
  if (rate == 0) return std::numeric_limits<double>::quiet_NaN();
  return std::log(before / after) / (2 * rate * interval);
}

double collision_rate(double pair_collisions, double particles, double elapsed) {
  return 2 * pair_collisions / (particles * elapsed);
}

double pressure(double n, double temperature, double virial, double particles, double elapsed,
                int d) {
  const double volume = particles / n;
  return n * temperature + virial / (d * volume * elapsed);
}

std::optional<double> tau_c(std::span<const double> tau, std::span<const double> temperature,
                            double e, int d) {
  if (tau.size() != temperature.size()) {
    throw std::invalid_argument("tau_c: as many temperatures as times are needed");
  }
  // In logarithms throughout: T_Haff itself underflows in long runs.
  const auto excess = [&](std::size_t i) {
    return std::log(temperature[i] / initial_temperature(d)) + 2 * gamma0(e, d) * tau[i];
  };
  for (std::size_t i = 1; i < tau.size(); ++i) {
    const double here = excess(i);
    if (here < std::numbers::ln2) continue;
    const double before = excess(i - 1);
    const double fraction = (std::numbers::ln2 - before) / (here - before);
    return tau[i - 1] + fraction * (tau[i] - tau[i - 1]);
  }
  return std::nullopt;
}

}  // namespace haff::analysis
