// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/loop/gas.hpp"

#include <cmath>

#include "engine/queue/upcoming.hpp"

namespace haff::engine {

// The approximate number of events per unit of time, which sizes the queue: Boltzmann's collision
// frequency plus the crossings of cells about one diameter wide. Only the speed depends on it.
double events_per_time(const Gas& gas) {
  const auto count = static_cast<double>(gas.particles.size());
  const double speed = std::sqrt(2 * kinetic_energy(gas.particles));
  return std::max(count * speed * (1 + 4 * count / gas.box.volume()), 1e-300);
}

void prepare(Gas& gas) {
  const auto count = static_cast<std::uint32_t>(gas.particles.size());
  gas.event_rate = events_per_time(gas);
  gas.queue.restart(gas.event_rate, count < worth_prefetching ? 0 : foresight);
  if (gas.team.size() == 1) {
    gas.bricks.clear();
    for (std::uint32_t p = 0; p < count; ++p) {
      gas.queue[p].cell = gas.bricks.locate(gas.particles[p].position);
      gas.bricks.insert(p, gas.queue[p].cell);
    }
    return;
  }
  gas.team.for_parts(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
      gas.queue[static_cast<std::uint32_t>(p)].cell = gas.bricks.locate(gas.particles[p].position);
  });
  // Every thread fills layers of its own.
  gas.team.for_parts(gas.bricks.layers(), [&](std::size_t begin, std::size_t end) {
    gas.bricks.clear_layers(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end));
    for (std::uint32_t p = 0; p < count; ++p) {
      const Cell cell = gas.queue[p].cell;
      if (const std::uint32_t layer = gas.bricks.layer_of(cell); layer >= begin && layer < end)
        gas.bricks.insert(p, cell);
    }
  });
}

}  // namespace haff::engine
