// What the threads share while they work off a window.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/parallel/slabs.hpp"
#include "engine/support/huge_vector.hpp"

namespace haff::engine {

// The phases of a window, in their order.
enum class Phase : std::uint8_t { slab, zone, box };
inline constexpr std::size_t phases = 3;

struct Division {
  explicit Division(unsigned count) : regions(count) {}

  unsigned regions;
  Slabs slabs;
  // The region in whose queue a particle's event is: that of the slab in which the particle is. It
  // changes in zones and the box only.
  std::vector<std::uint8_t> owner;
  // For each brick, the time of the last event of a particle in it, as the bits of a double, plus a
  // little in early phases (RegionLoop::slack). The highest bit says that the brick is frozen.
  HugeVector<std::uint64_t> marks;
};

}  // namespace haff::engine
