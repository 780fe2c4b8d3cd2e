// SPDX-License-Identifier: GPL-3.0-or-later

// What the threads share while they work off a window.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/parallel/slabs.hpp"
#include "engine/support/huge_vector.hpp"

namespace haff::engine {

inline constexpr float never_marked = -1;

struct Division {
  explicit Division(unsigned count) : regions(count) {}

  unsigned regions;
  Slabs slabs;
  // For each layer of cells of each brick, two for a brick: the time of the last event of a
  // particle in it, rounded, if it is within the reach of a zone.
  HugeVector<float> marks;
  // Where the mark is of this layer (0 or 1) of a brick; bricks are counted.
  static std::size_t mark_of(std::uint32_t brick, std::uint32_t layer) {
    return 2 * std::size_t{brick} + layer;
  }
  // For each brick, the cells in it that an event which waits for the zones may read, one bit each:
  // what comes near them has to wait, too.
  std::vector<std::uint8_t> frozen;
};

}  // namespace haff::engine
