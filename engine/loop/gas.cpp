// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/loop/gas.hpp"

#include <cmath>

namespace haff::engine {
// The approximate number of events per unit of time, which sizes the queue: Boltzmann's collision
// frequency plus the crossings of cells about one diameter wide. Only the speed depends on it.
double events_per_time(const Gas& gas) {
  const auto count = static_cast<double>(gas.particles.size());
  const double speed = std::sqrt(2 * kinetic_energy(gas.particles));
  return std::max(count * speed * (1 + 4 * count / gas.box.volume()), 1e-300);
}

void prepare(Gas& gas) {
  gas.bricks.clear();
  gas.queue.restart(events_per_time(gas), gas.particles.size() < worth_prefetching ? 0 : foresight);
  for (std::uint32_t p = 0; p < gas.particles.size(); ++p) {
    gas.queue[p].cell = gas.bricks.locate(gas.particles[p].position);
    gas.bricks.insert(p, gas.queue[p].cell);
  }
}

}  // namespace haff::engine
