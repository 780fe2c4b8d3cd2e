// What laws of restitution are made from (laws.hpp).
#pragma once

#include <map>
#include <span>
#include <stdexcept>
#include <string>

#include "engine/contact.hpp"

namespace haff::engine {

using Parameters = std::map<std::string, double>;

// A parameter that must be there and above zero. Throws std::invalid_argument.
inline double positive(const Parameters& parameters, const std::string& key) {
  const auto found = parameters.find(key);
  if (found == parameters.end() || !(found->second > 0))
    throw std::invalid_argument("the law of restitution needs " + key + " > 0");
  return found->second;
}

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
