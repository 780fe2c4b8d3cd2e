// SPDX-License-Identifier: GPL-3.0-or-later

// The data that the threads share during a window.
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
  // For each of the two layers of cells of each brick: the rounded time of the last event of a
  // particle in it, if the layer is within the reach of a zone.
  HugeVector<float> marks;
  // The index of the mark of this layer (0 or 1) of a brick; bricks are counted.
  static std::size_t mark_of(std::uint32_t brick, std::uint32_t layer) {
    return 2 * std::size_t{brick} + layer;
  }
  // For each brick, the cells in it that an event that waits for the zones may read, one bit per
  // cell: events near these cells have to wait, too.
  std::vector<std::uint8_t> frozen;
};

}  // namespace haff::engine
