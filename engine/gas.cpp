#include "engine/gas.hpp"

#include <cmath>

namespace haff::engine {
namespace {

// Rough number of events in a unit of time, to size the calendar: Boltzmann's collision frequency
// and the crossings of a cell about a diameter wide. Only speed depends on it.
double events_per_time(const Gas& gas) {
  const auto count = static_cast<double>(gas.particles.size());
  const double speed = std::sqrt(2 * kinetic_energy(gas.particles));
  return std::max(count * speed * (1 + 4 * count / gas.box.volume()), 1e-300);
}

}  // namespace

void prepare(Gas& gas) {
  gas.bricks.clear();
  gas.calendar.restart(events_per_time(gas),
                       gas.particles.size() < worth_prefetching ? 0 : foresight);
  for (std::uint32_t p = 0; p < gas.particles.size(); ++p) {
    gas.calendar[p].cell = gas.bricks.locate(gas.particles[p].position);
    gas.bricks.insert(p, gas.calendar[p].cell);
  }
}

}  // namespace haff::engine
