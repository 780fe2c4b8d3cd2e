// One particle in half a cache line, in single precision. Positions are in units of L / 2^32: they
// wrap by themselves, and the difference of two is that to the nearest image.
#pragma once

#include <array>
#include <cstdint>

namespace haff::single {

struct alignas(32) Particle {
  std::array<std::uint32_t, 3> position;  // at its own time [L / 2^32]
  float time;                             // since the last synchronization
  std::array<float, 3> velocity;
  std::uint32_t changes;  // collisions since the last synchronization
};
static_assert(sizeof(Particle) == 32);

struct Box {
  explicit Box(double length)
      : side(length),
        unit(static_cast<float>(length * 0x1p-32)),
        inverse(static_cast<float>(1 / length)) {}
  double volume() const { return side * side * side; }
  double side;
  float unit;     // of positions [sigma]
  float inverse;  // of the side
};

}  // namespace haff::single
