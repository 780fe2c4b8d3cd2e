// SPDX-License-Identifier: GPL-3.0-or-later

// The interface of a restitution model. The models are listed in restitution_models.hpp.
#pragma once

#include <span>

#include "engine/particles/particle.hpp"
#include "engine/support/parameters.hpp"

namespace haff::engine {

// The properties of a collision that a restitution model may use.
struct Impact {
  const Particle& a;  // records from before this collision; a particle with `changes` = 0 has not
  const Particle& b;  // collided since the last synchronization
  double now;
  double speed2;  // of approach along the normal, squared, in scaled units
  // Effective radius sigma_a sigma_b / (sigma_a + sigma_b) and reduced mass of the pair, relative
  // to those of a pair of species 1. They scale the strength of a model in a mixture of one
  // material.
  double radius;
  double mass;
};

// A restitution model that remembers nothing from one collision to the next derives from this.
struct Memoryless {
  // Reads the memory from the state that a simulation starts with; writes it to the state that the
  // simulation returns.
  void recall(const State&) {}
  void store(State&) const {}
  // Called before a synchronization resets the particles' clocks.
  void before_synchronization(std::span<const Particle>, double /*now*/) {}
  // From now on, true velocity = velocity * 2^-exponent.
  void scale(int /*exponent*/) {}
};

}  // namespace haff::engine
