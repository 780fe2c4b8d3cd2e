#include "campaign/calibration.hpp"

#include <algorithm>

#include "campaign/cpu_time.hpp"
#include "engine/initial.hpp"
#include "engine/simulation.hpp"

namespace haff::campaign {
namespace {

constexpr std::uint32_t largest = 200'000;
constexpr double densest = 0.9;

// Collisions run before the clock is read again.
constexpr std::int64_t stretch = 2'000;

}  // namespace

Calibration calibrate(int d, double n, std::uint32_t particles, double seconds) {
  const std::uint32_t tried = std::min(particles, largest);
  engine::Simulation gas({}, engine::initial_state(std::min(n, densest), tried, 0, d));
  const double start = cpu_seconds();
  double spent = 0;
  do {
    gas.run_to(gas.collisions() + stretch);
    spent = cpu_seconds() - start;
  } while (spent < seconds);
  return {.collisions_per_second = static_cast<double>(gas.collisions()) / spent,
          .bytes_per_particle = static_cast<double>(gas.memory()) / tried};
}

}  // namespace haff::campaign
