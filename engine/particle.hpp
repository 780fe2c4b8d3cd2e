// One particle, one cache line.
//
// A record changes only when its particle collides or the gas is synchronized: between those it
// flies straight, and where it is now follows from the record. Nothing else writes it, so a
// trajectory cannot depend on when anybody looked.
//
// Disks (d = 2) are spheres that have z = 0 and no velocity along it: what is computed from a pair
// of them has the bits that x and y alone would give.
#pragma once

#include <cstdint>

#include "engine/state.hpp"

namespace haff::engine {

struct alignas(64) Particle {
  Vector position;  // at its own time; not wrapped until the next synchronization
  double time;      // since the last synchronization
  Vector velocity;
  std::uint32_t id;       // its name for ever
  std::uint32_t changes;  // collisions since the last synchronization
};
static_assert(sizeof(Particle) == 64);

// The periodic box: a cube, for disks (d = 2) a square.
struct Box {
  explicit Box(double length, int dimension = 3)
      : side(length), inverse(1 / length), d(dimension) {}
  explicit Box(const State& state) : Box(state.box, state.d) {}

  double volume() const { return d == 2 ? side * side : side * side * side; }

  double side;
  double inverse;
  int d;
};

}  // namespace haff::engine
