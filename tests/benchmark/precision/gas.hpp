#pragma once
#include "engine/clock.hpp"
#include "engine/simulation.hpp"
#include "tests/benchmark/precision/bricks.hpp"
#include "tests/benchmark/precision/calendar.hpp"
#include "tests/benchmark/precision/particle.hpp"

namespace haff::single {

struct Gas {
  explicit Gas(const engine::State& state)
      : box(state.box),
        particles(state.particles()),
        ids(state.id),
        bricks(box, state.particles()),
        calendar(state.particles()) {}

  Box box;
  HugeVector<Particle> particles;
  std::vector<std::uint32_t> ids;
  Bricks bricks;
  Calendar calendar;
  engine::Clock clock;
  engine::Events events;
  double latest = 0;  // event in the past
};

}  // namespace haff::single
