// One particle, one cache line.
//
// A record changes only when its particle collides or the gas is synchronized: between those it
// flies straight, and where it is now follows from the record. Nothing else writes it, so a
// trajectory cannot depend on when anybody looked.
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

// The periodic cube.
struct Box {
  explicit Box(double length) : side(length), inverse(1 / length) {}
  double side;
  double inverse;
};

}  // namespace haff::engine
