// The two halves of a record in vector registers, for what changes it: where it is now, and its
// velocity.
//
// A record is written whole because it is read so: the search loads two neighbouring numbers at
// once, and a load wider than the stores before it waits until those have reached the cache. The
// two who have just collided are the first to be looked at by each other. (2 % of all time, with
// the instructions that four numbers at once save.)
//
// GCC's vectors, not Highway's: what collisions do is the same code for every target.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#include "engine/particle.hpp"

namespace haff::engine {

using Four [[gnu::vector_size(32)]] = double;
using FourWords [[gnu::vector_size(32)]] = std::int64_t;

struct Halves {
  [[gnu::always_inline]] Halves(const Particle& p, double now) {
    std::memcpy(&position, &p.position, sizeof position);
    std::memcpy(&names, &p.velocity, sizeof names);
    velocity = reinterpret_cast<Four>(names & FourWords{-1, -1, -1, 0});
    position += velocity * (now - position[3]);
    position[3] = now;
  }

  // Into its record, as changed once more.
  [[gnu::always_inline]] void write(Particle& p) const {
    static_assert(std::endian::native == std::endian::little);
    constexpr std::int64_t one_change = std::int64_t{1} << 32;
    const FourWords half = (reinterpret_cast<FourWords>(velocity) & FourWords{-1, -1, -1, 0}) |
                           ((names & FourWords{0, 0, 0, -1}) + FourWords{0, 0, 0, one_change});
    std::memcpy(&p.position, &position, sizeof position);
    std::memcpy(&p.velocity, &half, sizeof half);
  }

  Four position;    // and the time
  Four velocity;    // and nothing
  FourWords names;  // last, id and changes
};

[[gnu::always_inline]] inline double dot(const Four& a, const Four& b) {
  const Four products = a * b;
  return (products[0] + products[1]) + products[2];
}

// From what lies at r to its nearest image. Rounding to a whole number is what remains of adding,
// and taking away, a number whose neighbours are one apart.
[[gnu::always_inline]] inline void to_nearest_image(Four& r, const Box& box) {
  constexpr double whole = 0x1.8p52;
  r -= ((r * box.inverse + whole) - whole) * box.side;
}

}  // namespace haff::engine
