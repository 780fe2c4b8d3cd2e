// Which particles are near: cells of at least one diameter, eight of them in one cache line.
//
// A brick is 2 x 2 x 2 cells. Its particles lie in 16 slots of one 64-byte line, filled from the
// front; a slot says which particle and, in three bits, in which half of the brick along x, y, z.
// The 27 cells around any cell lie in 8 bricks, and in each of them the wanted cells are "that half
// along these axes": one AND and one comparison a slot, with masks from a small table. So a
// neighbourhood costs 8 lines, and a crossing within a brick changes one bit.
//
// A brick with more than 16 particles (a dense cluster) keeps the rest in an overflow list that
// nobody looks at unless the sixteenth slot is taken.
//
// Disks have a layer of bricks one cell high: their 9 cells lie in 4 bricks, and nobody looks or
// goes up or down.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "engine/memory.hpp"
#include "engine/particle.hpp"

namespace haff::engine {

// Cell coordinates, ten bits an axis.
struct Cell {
  std::uint32_t packed;

  std::uint32_t operator[](unsigned axis) const { return packed >> (10 * axis) & 1023; }
  void set(unsigned axis, std::uint32_t value) {
    packed = (packed & ~(1023u << (10 * axis))) | value << (10 * axis);
  }
  bool operator==(const Cell&) const = default;
};

// A face of a cell: 2 * axis, plus one if it is the upper one.
using Face = std::uint32_t;

struct Exit {
  double time;
  Face face;
};

class Bricks {
 public:
  static constexpr std::uint32_t slots = 16;
  // A slot, from its lowest bit: 1, the three halves, and the particle's number.
  static constexpr std::uint32_t occupied = 1;
  static constexpr unsigned half_shift = 1;
  static constexpr unsigned particle_shift = 4;
  static constexpr std::uint32_t particle_bits = ~0u << particle_shift;
  static constexpr std::uint32_t particle_in(std::uint32_t slot) { return slot >> particle_shift; }

  struct alignas(64) Line {
    std::array<std::uint32_t, slots> slot;  // 0 where empty
  };

  // Some bricks, and in each the slots with (slot & care) == value.
  template <std::size_t count>
  struct Masks {
    std::array<std::uint32_t, count> care;
    std::array<std::uint32_t, count> value;
  };
  template <std::size_t count>
  struct Wanted {
    std::array<std::uint32_t, count> brick;
    const Masks<count>* masks;
  };

  Bricks(const Box& box, std::uint32_t particles);

  // Smaller boxes cannot have cells of this size, four along an axis.
  static bool fits(const Box& box) { return box.side >= 4 * smallest_cell; }
  // With six, particles of neighbouring cells are less than half a box apart: no doubt about the
  // nearest image.
  bool tell_images_apart() const { return cells_ >= 6; }

  void clear();
  Cell locate(const Vector& position) const;  // of a wrapped position
  void insert(std::uint32_t particle, Cell cell);

  // When and through which face the particle leaves its cell.
  template <int d = 3>
  Exit exit(const Particle& p, Cell cell, double now) const;
  // Moves the particle through that face; returns its new cell.
  Cell cross(std::uint32_t particle, Cell cell, Face face);

  // The eight bricks around a cell (of disks four); the four (two) that hold the nine (three) cells
  // beyond one of its faces.
  template <int d = 3>
  Wanted<1 << d> around(Cell cell) const;
  template <int d = 3>
  Wanted<1 << (d - 1)> beyond(Cell cell, Face face) const;

  // The neighbour of a cell on the other side of a face.
  Cell across(Cell cell, Face face) const {
    const unsigned axis = face / 2;
    const std::uint32_t c = cell[axis] + 2 * (face & 1) - 1;
    cell.set(axis, c + (wraps(c, 0 - 1u) & cells_) - (wraps(c, cells_) & cells_));
    return cell;
  }

  std::uint32_t brick_of(Cell cell) const {
    return (((cell.packed >> 21) & 511) * bricks_ + ((cell.packed >> 11) & 511)) * bricks_ +
           ((cell.packed >> 1) & 511);
  }
  const Line& line(std::uint32_t brick) const { return lines_[brick]; }
  const std::vector<std::uint32_t>& overflow(std::uint32_t brick) const;

  double cell_side() const { return cell_side_; }
  std::size_t memory() const { return lines_.size() * sizeof(Line); }

 private:
  // A cell is a little larger than a diameter, so that rounding in the time of a crossing cannot
  // let a contact come before it. [sigma]
  static constexpr double smallest_cell = 1 + 1e-6;
  // Fewest particles a cell holds on average: in a dilute gas larger cells are crossed less often.
  // From 0.25 to 0.6 the rate is flat.
  static constexpr double smallest_occupancy = 0.4;
  static constexpr std::uint32_t most_cells = 1024;  // along an axis

  static std::uint32_t half_of(Cell cell) {
    return (cell.packed & 1) | (cell.packed >> 9 & 2) | (cell.packed >> 18 & 4);
  }
  // All ones if the two are equal. Which cells lie at the end of an axis is as good as random: a
  // branch on it is predicted wrong too often to be worth it (three of 24 a collision, once).
  static std::uint32_t wraps(std::uint32_t a, std::uint32_t b) { return 0 - std::uint32_t{a == b}; }
  // From a cell's brick to the other one that its neighbours along that axis are in.
  std::uint32_t step(Cell cell, unsigned axis) const {
    const std::uint32_t own = cell[axis] >> 1;
    const std::uint32_t down = (cell[axis] & 1) - 1;  // all ones, or zero for up
    const std::uint32_t end = (bricks_ - 1) & ~down;
    const std::uint32_t by = wraps(own, end) & (wrap_[axis] + stride_[axis]);
    return ((stride_[axis] - by) ^ down) - down;
  }

  // By the half a cell is in. Of brick n, which is its own but for the axes whose bit is set, only
  // the half that touches the cell.
  template <int d>
  static constexpr auto around_masks = [] {
    std::array<Masks<1 << d>, 1 << d> masks{};
    for (std::uint32_t half = 0; half < 1 << d; ++half)
      for (std::uint32_t n = 0; n < 1 << d; ++n) {
        masks[half].care[n] = occupied | n << half_shift;
        masks[half].value[n] = occupied | (n & ~half) << half_shift;
      }
    return masks;
  }();
  // By axis and half. Around a cell of the layer beyond a face, those bricks that hold the layer
  // itself; in them only its half.
  template <int d>
  static constexpr auto beyond_masks = [] {
    std::array<std::array<Masks<1 << (d - 1)>, 1 << d>, d> masks{};
    for (std::uint32_t axis = 0; axis < d; ++axis)
      for (std::uint32_t half = 0; half < 1 << d; ++half)
        for (std::uint32_t k = 0; k < 1 << (d - 1); ++k) {
          const std::uint32_t bit = 1u << axis;
          const std::uint32_t n = (k & ~(bit - 1)) << 1 | (k & (bit - 1));  // k, a zero at the axis
          masks[axis][half].care[k] = around_masks<d>[half].care[n] | bit << half_shift;
          masks[axis][half].value[k] = around_masks<d>[half].value[n] | (half & bit) << half_shift;
        }
    return masks;
  }();

  std::uint32_t& find(std::uint32_t brick, std::uint32_t particle);
  void remove(std::uint32_t particle, Cell cell);

  double side_;                          // of the box
  double inverse_;                       // of that
  std::uint32_t cells_;                  // along an axis, even
  std::uint32_t bricks_;                 // along an axis
  std::array<std::uint32_t, 3> stride_;  // from a brick to the next along an axis,
  std::array<std::uint32_t, 3> wrap_;    // and from the first to the last
  double cell_side_;
  HugeVector<Line> lines_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> overflow_;
};

template <int d>
[[gnu::always_inline]] inline Exit Bricks::exit(const Particle& p, Cell cell, double now) const {
  Exit first{std::numeric_limits<double>::infinity(), 0};
  for (unsigned axis = 0; axis < d; ++axis) {
    const double v = p.velocity[axis];
    const double x = p.position[axis] + v * (now - p.time);
    double to_centre = (cell[axis] + 0.5) * cell_side_ - x;
    to_centre -= std::rint(to_centre * inverse_) * side_;
    const double distance = 0.5 * cell_side_ + (v > 0 ? to_centre : -to_centre);
    const double time = now + std::max(distance, 0.0) / std::abs(v);
    if (time < first.time) first = {time, 2 * axis + (v > 0 ? 1u : 0u)};
  }
  return first;
}

template <int d>
[[gnu::always_inline]] inline Bricks::Wanted<1 << d> Bricks::around(Cell cell) const {
  const auto& masks = around_masks<d>[half_of(cell)];
  const std::uint32_t own = brick_of(cell);
  const std::uint32_t x = step(cell, 0);
  const std::uint32_t y = step(cell, 1);
  if constexpr (d == 2) {
    return {{own, own + x, own + y, own + x + y}, &masks};
  } else {
    const std::uint32_t z = step(cell, 2);
    return {
        {own, own + x, own + y, own + x + y, own + z, own + x + z, own + y + z, own + x + y + z},
        &masks};
  }
}

template <int d>
[[gnu::always_inline]] inline Bricks::Wanted<1 << (d - 1)> Bricks::beyond(Cell cell,
                                                                          Face face) const {
  const unsigned axis = face / 2;
  const Cell layer = across(cell, face);
  const auto& masks = beyond_masks<d>[axis][half_of(layer)];
  const std::uint32_t own = brick_of(layer);
  const std::uint32_t a = step(layer, axis == 0 ? 1 : 0);
  if constexpr (d == 2) {
    return {{own, own + a}, &masks};
  } else {
    const std::uint32_t b = step(layer, axis == 2 ? 1 : 2);
    return {{own, own + a, own + b, own + a + b}, &masks};
  }
}

}  // namespace haff::engine
