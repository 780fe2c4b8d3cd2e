// SPDX-License-Identifier: GPL-3.0-or-later

// How the box is divided among threads: slabs of whole layers of cells, and zones around the
// borders between them.
//
// An event reads the cells next to those of its particles and changes only these. In a slab, events
// are processed from the third layer of cells on, counted from the border: an event at the border,
// in another slab or in this one, then reads no cell that an event in the slab changes at the same
// time; nor do the two share a brick, wherever the border cuts one in two. What is left are the
// zones: an event belongs to one as long as it reads no cell that is
// farther from the border than `zone_cells`. Deeper inside a slab nothing can be disturbed by a
// zone, and no event has to leave a mark there (region.hpp).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/queue/event.hpp"
#include "engine/search/bricks.hpp"

namespace haff::engine {

class Slab {
 public:
  Slab() = default;
  // `zone_cells`: of the zones at both of its borders.
  Slab(const Bricks& bricks, std::uint32_t first_cell, std::uint32_t cells,
       std::uint32_t zone_cells)
      : axis_(bricks.last_axis()),
        cells_(bricks.cells()),
        first_(first_cell),
        own_(cells),
        zone_(zone_cells) {}

  // Whether a particle in this cell may have events while other threads work in their slabs.
  bool may_work_in(Cell cell) const { return is_inside(cell, border); }
  // Whether the cell is out of the reach of zones.
  bool is_deep(Cell cell) const { return is_inside(cell, zone_); }
  // Whether a particle in this cell can have its events in a zone.
  bool is_near_border(Cell cell) const { return !is_inside(cell, zone_ - 1); }
  // Whether the brick of a cell is in the slab, with both of its layers of cells, and whether the
  // next brick is that has neighbours of the cell.
  bool holds_brick_of(Cell cell) const {
    const std::uint32_t lower = cell[axis_] & ~1u;
    return height_of(lower) < own_ && height_of(lower + 1) < own_;
  }
  bool holds_brick_next_to(Cell cell) const {
    const std::uint32_t lower = (cell[axis_] & ~1u) + (cell[axis_] % 2 == 1 ? 2 : cells_ - 2);
    return height_of(lower) < own_ && height_of(lower + 1) < own_;
  }

  // Whether so many layers of cells of the slab, or more, are on either side between the cell and
  // the border.
  bool is_inside(Cell cell, std::uint32_t layers) const {
    return height(cell) - layers < own_ - std::min(2 * layers, own_);
  }
  // The number of these layers, on the side where it is smaller; zero outside of the slab.
  std::uint32_t depth(Cell cell) const {
    const std::uint32_t above = height(cell);
    return above < own_ ? std::min(above, own_ - 1 - above) : 0;
  }

  static constexpr std::uint32_t border = 2;  // layers of cells that belong to zones only

 private:
  // Above the lower border, in cells; at least `own_` outside of the slab.
  std::uint32_t height(Cell cell) const {
    const std::uint32_t from_first = cell[axis_] - first_;
    return from_first + (from_first >> 31) * cells_;
  }
  // The same for any layer of cells, counted on across the end of the box.
  std::uint32_t height_of(std::uint32_t layer) const { return (layer + cells_ - first_) % cells_; }
  unsigned axis_ = 0;
  std::uint32_t cells_ = 0;  // of the box
  std::uint32_t first_ = 0;
  std::uint32_t own_ = 0;
  std::uint32_t zone_ = 0;
};

// The cells around the border below a slab.
class Zone {
 public:
  Zone() = default;
  Zone(const Bricks& bricks, std::uint32_t cell_above, std::uint32_t zone_cells)
      : axis_(bricks.last_axis()),
        cells_(bricks.cells()),
        first_((cell_above + cells_ - (zone_cells - 1)) % cells_),
        count_(2 * (zone_cells - 1)) {}

  // Whether a particle in this cell may have events in the zone.
  bool may_work_in(Cell cell) const {
    const std::uint32_t from_first = cell[axis_] - first_;
    return from_first + (from_first >> 31) * cells_ < count_;
  }

 private:
  unsigned axis_ = 0;
  std::uint32_t cells_ = 0;
  std::uint32_t first_ = 0;
  std::uint32_t count_ = 0;
};

class Slabs {
 public:
  // Fewer layers of cells do not make a slab.
  static constexpr std::uint32_t fewest_cells = 8;
  // The number of slabs that fit, at most `wanted`.
  static unsigned most(const Bricks& bricks, unsigned wanted);

  // Divides the box so that every slab has about the same share of the work, which `work` gives for
  // each layer of cells.
  void divide(const Bricks& bricks, std::span<const std::uint32_t> work, unsigned slabs);

  const Slab& slab(unsigned k) const { return slabs_[k]; }
  const Zone& zone(unsigned k) const { return zones_[k]; }  // between slabs k - 1 and k
  std::uint8_t slab_of(Cell cell) const { return slab_of_[cell[axis_]]; }
  std::uint8_t zone_of(Cell cell) const { return zone_of_[cell[axis_]]; }  // the nearer one

 private:
  unsigned axis_ = 0;
  std::vector<Slab> slabs_;
  std::vector<Zone> zones_;
  // By layer of cells.
  std::vector<std::uint8_t> slab_of_;
  std::vector<std::uint8_t> zone_of_;
};

}  // namespace haff::engine
