// SPDX-License-Identifier: GPL-3.0-or-later

// The division of the box among threads: slabs of whole layers of cells, and zones around the
// borders between them.
//
// An event reads the cells next to those of its particles and changes only these. In a slab, events
// are processed from the third layer of cells on, counted from the border: an event at the border,
// in another slab or in this one, then reads no cell that an event in the slab changes at the same
// time; nor do the two share a brick, wherever the border cuts one in two. The rest are the
// zones: an event belongs to a zone as long as it reads no cell that is farther from the border
// than `zone_cells`. Deeper inside a slab a zone cannot disturb anything, and events leave no marks
// there (region.hpp).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/queue/event.hpp"
#include "engine/search/bricks.hpp"

namespace haff::engine {

// Layers of cells next to each other, not across the end of the box.
class Layers {
 public:
  Layers() = default;
  Layers(const Bricks& bricks, std::uint32_t first, std::uint32_t count)
      : shift_(10 * bricks.last_axis()), first_(first), count_(count) {}

  bool hold(Cell cell) const { return of(cell) - first_ < count_; }
  // The coordinate of a cell along the last axis: disks, whose last axis is y, have z = 0.
  std::uint32_t of(Cell cell) const { return cell.packed >> shift_; }
  std::uint32_t first() const { return first_; }
  std::uint32_t count() const { return count_; }

 private:
  unsigned shift_ = 0;
  std::uint32_t first_ = 0;
  std::uint32_t count_ = 0;
};

class Slab {
 public:
  Slab() = default;
  // `zone_cells`: the depth of the zones at both of its borders.
  Slab(const Bricks& bricks, std::uint32_t first_cell, std::uint32_t cells,
       std::uint32_t zone_cells)
      : bricks_(&bricks), own_(bricks, first_cell, cells), zone_(zone_cells) {}

  // The cells in which particles may have events while other threads work in their slabs.
  Layers workable() const { return inside(border); }
  // The cells out of the reach of zones.
  Layers deep() const { return inside(zone_); }
  // The cells whose particles cannot have their events in a zone.
  Layers beyond_zones() const { return inside(zone_ - 1); }
  // The cells with at least this many layers of the slab between them and the border on either
  // side.
  Layers inside(std::uint32_t layers) const {
    const std::uint32_t outside = std::min(2 * layers, own_.count());
    return {*bricks_, own_.first() + layers, own_.count() - outside};
  }
  // The number of these layers, on the side where it is smaller; zero outside of the slab.
  std::uint32_t depth(Cell cell) const {
    const std::uint32_t above = own_.of(cell) - own_.first();
    return own_.hold(cell) ? std::min(above, own_.count() - 1 - above) : 0;
  }

  std::uint32_t zone_cells() const { return zone_; }

  // Whether the brick of a cell is in the slab, with both of its layers of cells; and the same for
  // the next brick with neighbours of the cell.
  bool holds_brick_of(Cell cell) const { return holds_brick(own_.of(cell) & ~1u); }
  bool holds_brick_next_to(Cell cell) const {
    const std::uint32_t layer = own_.of(cell);
    return holds_brick((layer & ~1u) + (layer % 2 == 1 ? 2 : bricks_->cells() - 2));
  }

  static constexpr std::uint32_t border = 2;  // layers of cells that belong to zones only

 private:
  // `lower`: its lower layer of cells, counted on across the end of the box.
  bool holds_brick(std::uint32_t lower) const {
    const std::uint32_t above = lower % bricks_->cells() - own_.first();
    return above < own_.count() && above + 1 < own_.count();
  }

  const Bricks* bricks_ = nullptr;
  Layers own_;
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
  // The fewest layers of cells in a slab.
  static constexpr std::uint32_t fewest_cells = 8;
  // The number of slabs that fit, at most `wanted`.
  static unsigned most(const Bricks& bricks, unsigned wanted);

  // Divides the box so that every slab has about the same share of the work. `work` is that of each
  // layer of cells.
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
