// What laws of restitution are made from (laws.hpp).
#pragma once

#include <span>

#include "engine/contact.hpp"
#include "engine/parameters.hpp"

namespace haff::engine {

// A law that remembers nothing from one collision to the next: what happens to memory.
struct Forgetful {
  // From the state a simulation starts with, and into the one it hands out.
  void recall(const State&) {}
  void store(State&) const {}
  // Before a synchronization restarts the particles' clocks.
  void before_synchronization(std::span<const Particle>, double /*now*/) {}
  // From now on true velocity = velocity * 2^-exponent.
  void scale(int /*exponent*/) {}
};

}  // namespace haff::engine
