// SPDX-License-Identifier: GPL-3.0-or-later

// The interface of an action, an effect that changes velocities between collisions. The actions are
// listed in actions.hpp.
#pragma once

#include <cstdint>
#include <span>

#include "engine/particles/clock.hpp"
#include "engine/particles/particle.hpp"
#include "engine/particles/synchronize.hpp"
#include "engine/support/parameters.hpp"
#include "engine/support/random.hpp"

namespace haff::engine {

class Action {
 public:
  Action() = default;
  virtual ~Action() = default;
  Action(const Action&) = delete;
  Action& operator=(const Action&) = delete;

  // The first collision number after `collisions` at which the action is due. It depends on the two
  // numbers alone, so that a resumed run acts where an uninterrupted run does.
  virtual std::int64_t next(std::int64_t collisions, std::size_t particles) const = 0;

  // Changes the velocities of a gas that has just been synchronized, but not its total momentum.
  virtual void act(std::span<Particle> particles, const Clock& clock) = 0;

  // Writes what the action remembers into State::memory.
  virtual void store(State&) const {}

  bool is_due(std::int64_t collisions, std::size_t particles) const {
    return next(collisions - 1, particles) == collisions;
  }
};

}  // namespace haff::engine
