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
#include "tests/benchmark/precision/particle.hpp"

namespace haff::single {

template <class T>
using HugeVector = engine::HugeVector<T>;

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
  float time;
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
    std::array<std::uint32_t, slots> slot;  // filled from the front; 0 where empty
  };

  // The bits of a slot that matter, once for each slot of half a line: a vector can take them.
  using Care = std::array<std::uint32_t, 8>;

  // Some bricks, and in each the wanted slots: those that equal `like` where it matters.
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

  // Smaller boxes cannot have cells of this size, four along an axis.
  static bool fits(const Box& box) { return box.side >= 4 * smallest_cell; }
  // With six, particles of neighbouring cells are less than half a box apart: no doubt about the
  // nearest image.
  bool tell_images_apart() const { return cells_ >= 6; }

  void clear();
  Cell locate(const std::array<std::uint32_t, 3>& position) const;
  void insert(std::uint32_t particle, Cell cell);

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
    return along(cell, 0).own + along(cell, 1).own + along(cell, 2).own;
  }
  const Line& line(std::uint32_t brick) const { return lines_[brick / slots]; }
  const std::uint32_t* all_slots() const { return lines_.data()->slot.data(); }
  const std::vector<std::uint32_t>& overflow(std::uint32_t brick) const;

  float cell_side() const { return static_cast<float>(cell_side_); }
  std::int32_t half_cell() const { return half_cell_; }  // [L / 2^32]
  std::size_t memory() const { return lines_.size() * sizeof(Line); }

 private:
  // A cell is a little larger than a diameter, so that rounding in the time of a crossing cannot
  // let a contact come before it. [sigma]
  static constexpr double smallest_cell = 1 + 1e-3;
  // Fewest particles a cell holds on average: in a dilute gas larger cells are crossed less often.
  // From 0.25 to 0.6 the rate is flat.
  static constexpr double smallest_occupancy = 0.4;
  static constexpr std::uint32_t most_cells = 1024;  // along an axis

  // A brick's number is that of its first slot, and a sum over the axes. Of a cell, along one of
  // them: what its own brick and the other one that its neighbours are in add to theirs.
  struct Share {
    std::uint32_t own;
    std::uint32_t next;
  };
  const Share& along(Cell cell, unsigned axis) const { return shares_[axis][cell[axis]]; }

  // In which half of its brick a cell is along x, y and z: the lowest bits of its coordinates,
  // which the product puts side by side.
  static std::uint32_t half_of(Cell cell) {
    constexpr std::uint32_t lowest = 1 | 1 << 10 | 1 << 20;
    return (cell.packed & lowest) * (1 << 20 | 1 << 11 | 1 << 2) >> 20 & 7;
  }
  // All ones if the two are equal. Which cells lie at the end of an axis is as good as random: a
  // branch on it is predicted wrong too often to be worth it (three of 24 a collision, once).
  static std::uint32_t wraps(std::uint32_t a, std::uint32_t b) { return 0 - std::uint32_t{a == b}; }

  // Around a cell: of brick n, which is its own but for the axes whose bit is set, only the half
  // that touches the cell, which is the other one than its own.
  static std::uint32_t care_around(std::uint32_t n) { return occupied | n << half_shift; }
  // Around a cell of the layer beyond a face, those bricks that hold the layer itself; in them only
  // its half.
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
  // How many slots are taken, and which one holds the entry. No branches, so that the compiler
  // makes vectors of them.
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

  std::int32_t half_cell_;
  std::uint32_t cells_;  // along an axis, even
  double cell_side_;
  std::array<std::vector<Share>, 3> shares_;  // by axis and coordinate
  // Not constants: GCC would make each anew, in three instructions, where one loads it.
  alignas(32) std::array<Care, 8> care_around_;
  alignas(32) std::array<std::array<Care, 4>, 3> care_beyond_;  // by axis
  HugeVector<Line> lines_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> overflow_;
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
  // Removed and inserted as above, but without a branch: where a particle's slot is, how many there
  // are and whether the two bricks are one is as good as random.
  const std::size_t last = taken(left) - 1;
  const std::size_t end = taken(entered) - (&left == &entered ? 1 : 0);
  left[place_of(entry(particle, cell), left)] = left[last];
  left[last] = 0;
  entered[end] = entry(particle, to);
  return to;
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

}  // namespace haff::single
