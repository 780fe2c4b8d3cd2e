// SPDX-License-Identifier: GPL-3.0-or-later

// Bricks: the 27 cells (9 for disks) around a cell, the nine beyond a face, crowded bricks, and how
// a particle leaves a cell.
#include "engine/search/bricks.hpp"

#include <doctest/doctest.h>

#include <set>

using namespace haff::engine;

namespace {

const Box box(8.4);  // eight cells along an axis

template <std::size_t count>
std::multiset<std::uint32_t> found(const Bricks& bricks, const Bricks::Wanted<count>& wanted) {
  std::multiset<std::uint32_t> particles;
  for (std::size_t n = 0; n < count; ++n) {
    const auto take = [&](std::uint32_t slot) {
      if (wanted.holds(n, slot)) particles.insert(Bricks::particle_in(slot));
    };
    for (const std::uint32_t slot : bricks.line(wanted.brick[n]).slot) take(slot);
    for (const std::uint32_t slot : bricks.overflow(wanted.brick[n])) take(slot);
  }
  return particles;
}

// One particle in each cell, numbered as its cell is packed.
Bricks one_in_each() {
  Bricks bricks(box, 2000);
  for (std::uint32_t x = 0; x < 8; ++x)
    for (std::uint32_t y = 0; y < 8; ++y)
      for (std::uint32_t z = 0; z < 8; ++z)
        bricks.insert(x | y << 10 | z << 20, {x | y << 10 | z << 20});
  return bricks;
}

// Cells whose offset from the centre, per axis, is accepted; the box is periodic.
template <class Accept>
std::multiset<std::uint32_t> cells(Cell centre, const Accept& accept) {
  std::multiset<std::uint32_t> all;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const int offset[3] = {x, y, z};
        if (!accept(offset)) continue;
        Cell cell{0};
        for (unsigned axis = 0; axis < 3; ++axis)
          cell.set(axis, (centre[axis] + 8 + static_cast<std::uint32_t>(offset[axis])) % 8);
        all.insert(cell.packed);
      }
  return all;
}

}  // namespace

TEST_CASE("around a cell are its 27 cells, once each") {
  const Bricks bricks = one_in_each();
  for (const Cell centre : {Cell{0}, Cell{7 | 7 << 10 | 7 << 20}, Cell{3 | 4 << 10 | 0 << 20}})
    CHECK(found(bricks, bricks.around(centre)) == cells(centre, [](const int*) { return true; }));
}

TEST_CASE("beyond a face are nine cells") {
  const Bricks bricks = one_in_each();
  for (const Cell centre : {Cell{0}, Cell{7 | 6 << 10 | 1 << 20}})
    for (Face face = 0; face < 6; ++face) {
      CAPTURE(face);
      const int side = (face & 1) != 0 ? 1 : -1;
      const auto beyond =
          cells(centre, [&](const int* offset) { return offset[face / 2] == side; });
      CHECK(found(bricks, bricks.beyond(centre, face)) == beyond);
    }
}

TEST_CASE("a brick holds any number of particles") {
  Bricks bricks(box, 2000);
  std::multiset<std::uint32_t> expected;
  for (std::uint32_t p = 0; p < 40; ++p) {
    bricks.insert(p, Cell{0});
    expected.insert(p);
  }
  CHECK(found(bricks, bricks.around(Cell{0})) == expected);
  // All particles but one leave, from the line and from the overflow, through the lower x face.
  for (std::uint32_t p = 0; p < 39; ++p) {
    CHECK(bricks.cross(p, Cell{0}, 0) == Cell{7});
    expected.erase(p);
    CHECK(found(bricks, bricks.beyond(Cell{1}, 0)) == expected);
  }
}

TEST_CASE("a particle leaves through the face ahead, when it reaches it") {
  const Bricks bricks(box, 2000);
  const double cell = bricks.cell_side();
  Particle p{};
  p.position = {0.25 * cell, 0.5 * cell, 0.5 * cell};
  p.velocity = {-1, 0.25, 0};
  const Exit exit = bricks.exit(p, bricks.locate(p.position), 0);
  CHECK(exit.face == 0);
  CHECK(exit.time == doctest::Approx(0.25 * cell));
  // On the face, or slightly beyond it, the particle leaves at once, never in the past.
  CHECK(bricks.exit(p, Cell{0}, 0.25 * cell).time == doctest::Approx(0.25 * cell));
  CHECK(bricks.exit(p, Cell{0}, 0.26 * cell).time == 0.26 * cell);
}

TEST_CASE(
    "a disk's cell has nine around it and three beyond a face, and no disk leaves up or down") {
  const Box square(8.4, 2);
  Bricks bricks(square, 2000);
  for (std::uint32_t x = 0; x < 8; ++x)
    for (std::uint32_t y = 0; y < 8; ++y) bricks.insert(x | y << 10, {x | y << 10});
  for (const Cell centre : {Cell{0}, Cell{7 | 7 << 10}, Cell{3 | 4 << 10}}) {
    CHECK(found(bricks, bricks.around<2>(centre)) ==
          cells(centre, [](const int* offset) { return offset[2] == 0; }));
    for (Face face = 0; face < 4; ++face) {
      CAPTURE(face);
      const int side = (face & 1) != 0 ? 1 : -1;
      CHECK(found(bricks, bricks.beyond<2>(centre, face)) == cells(centre, [&](const int* offset) {
              return offset[2] == 0 && offset[face / 2] == side;
            }));
    }
  }
  Particle p{};
  p.position = {0.5, 0.5, 0};
  p.velocity = {0, 1e-3, 0};
  CHECK(bricks.exit<2>(p, Cell{0}, 0).face == 3);
}
