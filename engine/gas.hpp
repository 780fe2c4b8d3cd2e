// Everything a simulation holds: the particles, where they are near each other, what each does
// next, and the clock. The event loop (event_loop-inl.hpp) moves it.
#pragma once

#include <optional>

#include "engine/bricks.hpp"
#include "engine/calendar.hpp"
#include "engine/mixture.hpp"
#include "engine/simulation.hpp"
#include "engine/synchronize.hpp"

namespace haff::engine {

struct Gas {
  explicit Gas(const State& state)
      : box(state),
        particles(state.particles()),
        bricks(box, state.particles()),
        calendar(state.particles()),
        clock(to_clock(state)),
        mixture(mixture_in(state)) {
    copy_particles(state, particles);
  }

  // Whether of a neighbour only the nearest image can be met.
  bool tells_images_apart() const { return Bricks::fits(box) && bricks.tell_images_apart(); }

  Box box;
  HugeVector<Particle> particles;
  Bricks bricks;
  Calendar calendar;
  Clock clock;
  Events events;
  std::optional<Mixture>
      mixture;  // for what is asked seldom; collisions know it from their physics
};

// From here on a gas is so far beyond the second-level cache that the processor alone cannot hide
// what it waits for; below, looking ahead costs more than it gains (a sixth at 4000). So many
// events the calendar then knows in order; from 8 to 32 the rate is flat.
inline constexpr std::size_t worth_prefetching = 20000;
inline constexpr std::uint32_t foresight = 12;

// Cells and an empty calendar for a gas that has just been synchronized.
void prepare(Gas& gas);

}  // namespace haff::engine
