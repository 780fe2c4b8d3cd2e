// SPDX-License-Identifier: GPL-3.0-or-later

// Everything that a simulation holds: the particles, their cells, their next events, and the clock.
// The event loop (event_loop-inl.hpp) moves it.
#pragma once

#include <optional>

#include "engine/mixture.hpp"
#include "engine/particles/synchronize.hpp"
#include "engine/queue/ladder_queue.hpp"
#include "engine/search/bricks.hpp"
#include "engine/simulation.hpp"
#include "engine/support/team.hpp"

namespace haff::engine {

struct Gas {
  explicit Gas(const State& state)
      : box(state),
        particles(state.particles()),
        bricks(box, state.particles()),
        queue(state.particles()),
        clock(to_clock(state)),
        mixture(mixture_in(state)) {
    copy_particles(state, particles);
  }

  // Whether a particle can meet only the nearest image of a neighbour.
  bool tells_images_apart() const { return Bricks::fits(box) && bricks.tell_images_apart(); }

  Box box;
  HugeVector<Particle> particles;
  Bricks bricks;
  LadderQueue queue;
  Clock clock;
  Events events;
  Team team;              // the threads that work on this gas
  double event_rate = 0;  // per unit of time, approximately, since the last synchronization
  std::optional<Mixture> mixture;  // for rare use; collisions know it from the pair geometry
};

// From this number of particles on, a gas exceeds the second-level cache by so much that the
// processor alone cannot hide the latency of memory; below, prefetching costs more than it gains (a
// sixth of the speed at 4000).
inline constexpr std::size_t worth_prefetching = 20000;

// The approximate number of events per unit of time, which sizes the queue. Only the speed depends
// on it.
double events_per_time(const Gas& gas);

// Fills the cells and empties the queue, for a gas that has just been synchronized.
void prepare(Gas& gas);

}  // namespace haff::engine
