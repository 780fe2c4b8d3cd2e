// SPDX-License-Identifier: GPL-3.0-or-later

// Finds the particles nearby: linked cells of at least one diameter, eight of them in one cache
// line.
//
// A brick is 2 x 2 x 2 cells. Its particles are in the 16 slots of one 64-byte line, filled from
// the front; a slot holds a particle number and, in three bits, the half of the brick along x, y
// and z. The 27 cells around any cell lie in 8 bricks, and in each of these the wanted cells are
// those of "one half along these axes": one AND and one comparison per slot, with masks from a
// small table. So a neighbourhood costs 8 lines, and a crossing within a brick changes one bit.
//
// If a brick has more than 16 particles (a dense cluster), the rest is in an overflow list that is
// read only if the sixteenth slot is taken.
//
// Disks have one layer of bricks, one cell high: their 9 cells lie in 4 bricks, and no disk
// searches or moves up or down.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "engine/particles/box.hpp"
#include "engine/particles/particle.hpp"
#include "engine/support/huge_vector.hpp"

namespace haff::engine {

// Cell coordinates, ten bits per axis.
struct Cell {
  std::uint32_t packed;

  std::uint32_t operator[](unsigned axis) const { return packed >> (10 * axis) & 1023; }
  void set(unsigned axis, std::uint32_t value) {
    packed = (packed & ~(1023u << (10 * axis))) | value << (10 * axis);
  }
  bool operator==(const Cell&) const = default;
};

// A face of a cell: 2 * axis, plus one if it is the upper face.
using Face = std::uint32_t;

struct Exit {
  double time;
  Face face;
};

class Bricks {
 public:
  static constexpr std::uint32_t slots = 16;
  // A slot, from its lowest bit: 1, the three halves, the particle number.
  static constexpr std::uint32_t occupied = 1;
  static constexpr unsigned half_shift = 1;
  static constexpr unsigned particle_shift = 4;
  static constexpr std::uint32_t particle_bits = ~0u << particle_shift;
  static constexpr std::uint32_t particle_in(std::uint32_t slot) { return slot >> particle_shift; }

  struct alignas(64) Line {
    std::array<std::uint32_t, slots> slot;  // filled from the front; 0 where empty
  };

  // The bits of a slot that matter, repeated for each slot of half a line, so that a vector can
  // load them.
  using Care = std::array<std::uint32_t, 8>;

  // Some bricks, and the wanted slots in each: those that equal `like` in the bits that matter.
  template <std::size_t count>
  struct Wanted {
    bool holds(std::size_t n, std::uint32_t slot) const {
      return ((slot ^ like) & care[n][0]) == 0;
    }

    std::array<std::uint32_t, count> brick;  // numbers
    std::uint32_t like;
    const Care* care;  // in each brick
  };

  Bricks(const Box& box, std::uint32_t particles);

  // Whether the box is large enough for four cells along an axis.
  static bool fits(const Box& box) { return box.side >= 4 * smallest_cell; }
  // The number of cells along an axis, for this many particles.
  static std::uint32_t cells_along(const Box& box, std::uint32_t particles);
  // Whether the nearest image is certain: with six cells along an axis, particles in neighbouring
  // cells are less than half a box apart.
  bool tell_images_apart() const { return cells_ >= 6; }

  void clear() { clear_layers(0, layers_); }
  void clear_layers(std::uint32_t begin, std::uint32_t end);
  Cell locate(const Vector& position) const;  // the cell of a wrapped position
  void insert(std::uint32_t particle, Cell cell);

  // The time at which the particle leaves its cell, and the face through which it does.
  template <int d = 3>
  Exit exit(const Particle& p, Cell cell, double now) const;
  // Moves the particle through that face; returns its new cell.
  Cell cross(std::uint32_t particle, Cell cell, Face face);

  // Moves the particle from one cell to another.
  void move(std::uint32_t particle, Cell from, Cell to) {
    remove(particle, from);
    insert(particle, to);
  }

  // Bricks form layers along the last axis.
  std::uint32_t layers() const { return layers_; }
  std::uint32_t layer_of(Cell cell) const { return cell[last_axis_] / 2; }
  std::uint32_t cells() const { return cells_; }  // along an axis
  unsigned last_axis() const { return last_axis_; }
  std::size_t count() const { return lines_.size(); }

  // The eight bricks around a cell (four for disks), and the four (two) bricks with the nine
  // (three) cells beyond one of its faces.
  template <int d = 3>
  Wanted<1 << d> around(Cell cell) const;
  template <int d = 3>
  Wanted<1 << (d - 1)> beyond(Cell cell, Face face) const;

  // The neighbour of a cell on the other side of a face.
  [[gnu::always_inline]] Cell across(Cell cell, Face face) const {
    const unsigned axis = face / 2;
    const std::uint32_t c = cell[axis] + 2 * (face & 1) - 1;
    cell.set(axis, c + (wraps(c, 0 - 1u) & cells_) - (wraps(c, cells_) & cells_));
    return cell;
  }

  // Whether two cells are the same or next to each other.
  bool are_neighbours(Cell a, Cell b) const {
    bool near = true;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const std::uint32_t from = b[axis] - a[axis] + 1;  // 0, 1, 2, or across the box
      near = near && (from <= 2 || from == cells_ || from - 2 + cells_ == 0);
    }
    return near;
  }

  // The cells of brick n around a cell, in the order of around(), that are the cell itself or next
  // to it; bit h stands for the cell in half h of the brick.
  static std::uint8_t near_cells(std::size_t n, Cell cell) { return near_cells_[n][half_of(cell)]; }

  std::uint32_t brick_of(Cell cell) const {
    return along(cell, 0).own + along(cell, 1).own + along(cell, 2).own;
  }
  const Line& line(std::uint32_t brick) const { return lines_[brick / slots]; }
  const std::uint32_t* all_slots() const { return lines_.data()->slot.data(); }
  const std::vector<std::uint32_t>& overflow(std::uint32_t brick) const;

  double cell_side() const { return cell_side_; }
  std::size_t memory() const { return lines_.size() * sizeof(Line); }

 private:
  // A cell is a little larger than a diameter, so that a contact cannot come before a crossing
  // because the time of the crossing was rounded. [sigma]
  static constexpr double smallest_cell = 1 + 1e-6;
  // The smallest average number of particles in a cell: larger cells are crossed less often in a
  // dilute gas. From 0.25 to 0.6 the speed does not depend on it.
  static constexpr double smallest_occupancy = 0.4;
  static constexpr std::uint32_t most_cells = 1024;  // along an axis

  // The number of a brick is that of its first slot, and a sum over the axes. For a cell and an
  // axis, these are the terms of its own brick and of the other brick that its neighbours are in.
  struct Share {
    std::uint32_t own;
    std::uint32_t next;
  };
  const Share& along(Cell cell, unsigned axis) const { return shares_[axis][cell[axis]]; }

  // The half of its brick that a cell is in, along x, y and z: the lowest bits of its coordinates,
  // which the product puts side by side.
  static std::uint32_t half_of(Cell cell) {
    constexpr std::uint32_t lowest = 1 | 1 << 10 | 1 << 20;
    return (cell.packed & lowest) * (1 << 20 | 1 << 11 | 1 << 2) >> 20 & 7;
  }
  // All ones if the two are equal. Whether a cell lies at the end of an axis is as good as random:
  // with a branch on it, 3 of 24 mispredictions per collision came from here.
  static std::uint32_t wraps(std::uint32_t a, std::uint32_t b) { return 0 - std::uint32_t{a == b}; }

  // Around a cell: bit k of n says whether brick n is the next one along axis k rather than the
  // cell's own. Only the half of it that touches the cell is wanted, which is the other half than
  // the cell's.
  static std::uint32_t care_around(std::uint32_t n) { return occupied | n << half_shift; }
  static constexpr std::array<std::array<std::uint8_t, 8>, 8> near_cells_ = [] {
    std::array<std::array<std::uint8_t, 8>, 8> cells{};
    for (std::uint32_t n = 0; n < 8; ++n)
      for (std::uint32_t own = 0; own < 8; ++own)
        for (std::uint32_t half = 0; half < 8; ++half)
          if ((n & (half ^ ~own)) == 0) cells[n][own] |= static_cast<std::uint8_t>(1u << half);
    return cells;
  }();
  // Around a cell of the layer beyond a face: only the bricks that hold the layer itself, and in
  // them only its half.
  static std::uint32_t care_beyond(std::uint32_t axis, std::uint32_t k) {
    const std::uint32_t bit = 1u << axis;
    const std::uint32_t n = (k & ~(bit - 1)) << 1 | (k & (bit - 1));  // k, a zero at the axis
    return care_around(n | bit);
  }
  static std::uint32_t like(std::uint32_t half) { return occupied | half << half_shift; }

  static std::uint32_t entry(std::uint32_t particle, Cell cell) {
    return like(half_of(cell)) | particle << particle_shift;
  }
  void remove(std::uint32_t particle, Cell cell);

  using Slots = std::array<std::uint32_t, slots>;
  // The number of slots that are taken, and the slot that holds the entry. There are no branches,
  // so the compiler vectorizes these loops.
  [[gnu::always_inline]] static std::size_t taken(const Slots& slot) {
    std::uint32_t count = 0;
    for (const std::uint32_t entry : slot) count += entry != 0 ? 1 : 0;
    return count;
  }
  [[gnu::always_inline]] static std::size_t place_of(std::uint32_t entry, const Slots& slot) {
    std::uint32_t place = 0;
    for (std::uint32_t k = 0; k < slots; ++k) place |= slot[k] == entry ? k : 0;
    return place;
  }

  double side_;          // of the box
  double inverse_;       // of the side
  std::uint32_t cells_;  // along an axis, even
  double cell_side_;
  std::array<std::vector<Share>, 3> shares_;  // by axis and coordinate
  // Members rather than constants: GCC would build a constant with three instructions each time,
  // where one instruction loads a member.
  alignas(32) std::array<Care, 8> care_around_;
  alignas(32) std::array<std::array<Care, 4>, 3> care_beyond_;  // by axis
  HugeVector<Line> lines_;
  unsigned last_axis_;
  std::uint32_t layers_;
  std::uint32_t in_layer_;  // numbers of bricks in a layer
  // By layer, so that several threads, each in layers of its own, can use them at the same time.
  std::vector<std::unordered_map<std::uint32_t, std::vector<std::uint32_t>>> overflow_;
};

[[gnu::always_inline]] inline Cell Bricks::cross(std::uint32_t particle, Cell cell, Face face) {
  const Cell to = across(cell, face);
  auto& left = lines_[brick_of(cell) / slots].slot;
  auto& entered = lines_[brick_of(to) / slots].slot;
  if (left.back() != 0 || entered.back() != 0) [[unlikely]] {
    remove(particle, cell);
    insert(particle, to);
    return to;
  }
  // Removes and inserts as above, but without a branch: the particle's slot, the number of slots
  // taken, and whether the two bricks are the same are as good as random.
  const std::size_t last = taken(left) - 1;
  const std::size_t end = taken(entered) - (&left == &entered ? 1 : 0);
  left[place_of(entry(particle, cell), left)] = left[last];
  left[last] = 0;
  entered[end] = entry(particle, to);
  return to;
}

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
  const auto [x, nx] = along(cell, 0);
  const auto [y, ny] = along(cell, 1);
  const std::uint32_t wanted = like(~half_of(cell));
  if constexpr (d == 2) {
    return {{x + y, nx + y, x + ny, nx + ny}, wanted, care_around_.data()};
  } else {
    const auto [z, nz] = along(cell, 2);
    return {{x + (y + z), nx + (y + z), x + (ny + z), nx + (ny + z),  //
             x + (y + nz), nx + (y + nz), x + (ny + nz), nx + (ny + nz)},
            wanted,
            care_around_.data()};
  }
}

template <int d>
[[gnu::always_inline]] inline Bricks::Wanted<1 << (d - 1)> Bricks::beyond(Cell cell,
                                                                          Face face) const {
  const unsigned axis = face / 2;
  const Cell layer = across(cell, face);
  const std::uint32_t wanted = like(~half_of(layer) ^ 1u << axis);
  const std::uint32_t c = along(layer, axis).own;
  const auto [a, na] = along(layer, axis == 0 ? 1 : 0);
  if constexpr (d == 2) {
    return {{c + a, c + na}, wanted, care_beyond_[axis].data()};
  } else {
    const auto [b, nb] = along(layer, axis == 2 ? 1 : 2);
    return {{a + (c + b), na + (c + b), a + (c + nb), na + (c + nb)},
            wanted,
            care_beyond_[axis].data()};
  }
}

}  // namespace haff::engine
