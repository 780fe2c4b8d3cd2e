// What actions are made from (actions.hpp).
#pragma once

#include <cstdint>
#include <span>

#include "engine/clock.hpp"
#include "engine/parameters.hpp"
#include "engine/particle.hpp"
#include "engine/random.hpp"
#include "engine/synchronize.hpp"

namespace haff::engine {

class Action {
 public:
  Action() = default;
  virtual ~Action() = default;
  Action(const Action&) = delete;
  Action& operator=(const Action&) = delete;

  // The first collision number after `collisions` at which it is to be done. A function of the
  // numbers alone, so that a resumed run acts where an uninterrupted one does.
  virtual std::int64_t next(std::int64_t collisions, std::size_t particles) const = 0;

  // Changes the velocities of a gas that has just been synchronized, leaving its momentum.
  virtual void act(std::span<Particle> particles, const Clock& clock) = 0;

  // What it remembers, into State::memory.
  virtual void store(State&) const {}

  bool is_due(std::int64_t collisions, std::size_t particles) const {
    return next(collisions - 1, particles) == collisions;
  }
};

}  // namespace haff::engine
