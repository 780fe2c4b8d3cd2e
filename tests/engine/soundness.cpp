// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/soundness.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "engine/initial.hpp"
#include "engine/simulation.hpp"

using namespace haff;
using namespace haff::engine;

namespace {

engine::State a_state(std::uint32_t particles = 500) {
  return engine::initial_state(0.4, particles, 1);
}

bool mentions(const std::optional<std::string>& text, const char* part) {
  return text && text->find(part) != std::string::npos;
}

// Moves particle b to touch particle a with this overlap, along x.
engine::State with_overlap(double overlap, std::uint32_t particles = 500) {
  engine::State state = a_state(particles);
  state.position[1] = state.position[0];
  state.position[1][0] += 1 - overlap;
  if (state.position[1][0] >= state.box) state.position[1][0] -= state.box;
  return state;
}

}  // namespace

TEST_CASE("soundness: a gas that has collided is sound") {
  engine::Simulation gas({.restitution = 0.9}, a_state());
  gas.run_to(engine::collisions_at(20, 500));
  CHECK_FALSE(unsoundness(gas.state()));
}

TEST_CASE("soundness: an overlap is named with its pair and depth") {
  const engine::State state = with_overlap(1e-3);
  const auto wrong = unsoundness(state);
  CHECK(mentions(wrong, "overlap"));
  CHECK(mentions(wrong, ("particles " + std::to_string(state.id[0])).c_str()));
}

TEST_CASE("soundness: an overlap from rounding is allowed, and a larger one is not") {
  // The pair is alone in the box, so that moving one of them makes no other overlap.
  const auto pair = [](double overlap) {
    engine::State state = engine::initial_state(0.01, 2, 1);
    state.position = {{0.1, 2, 2}, {0.1 + 1 - overlap, 2, 2}};
    return state;
  };
  CHECK_FALSE(unsoundness(pair(1e-12)));
  CHECK(unsoundness(pair(1e-9)));
}

TEST_CASE("soundness: an overlap across the face of the box is found") {
  engine::State state = engine::initial_state(0.01, 2, 1);
  state.position = {{0.1, 2, 2}, {state.box - 0.1, 2, 2}};
  CHECK(mentions(unsoundness(state), "overlap"));
}

TEST_CASE("soundness: overlaps are found in boxes of any number of cells") {
  for (const std::uint32_t particles : {8U, 32U, 100U, 4000U}) {
    CAPTURE(particles);
    CHECK_FALSE(unsoundness(a_state(particles)));
    CHECK(mentions(unsoundness(with_overlap(0.01, particles)), "overlap"));
  }
}

TEST_CASE("soundness: values that are not finite are named with their particle") {
  engine::State state = a_state();
  state.velocity[7][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(mentions(unsoundness(state), ("particle " + std::to_string(state.id[7])).c_str()));
}

TEST_CASE("soundness: a particle outside the box is named") {
  engine::State state = a_state();
  state.position[3][2] = state.box;
  CHECK(mentions(unsoundness(state), "outside the box"));
}

TEST_CASE("soundness: an id that occurs twice is named") {
  engine::State state = a_state();
  state.id[5] = state.id[6];
  CHECK(mentions(unsoundness(state), "twice"));
}

TEST_CASE("soundness: arrays of different lengths are refused") {
  engine::State state = a_state();
  state.velocity.pop_back();
  CHECK(mentions(unsoundness(state), "do not make a gas"));
}

TEST_CASE("soundness: time before the start is refused") {
  engine::State state = a_state();
  state.time = -1;
  CHECK(mentions(unsoundness(state), "time -1"));
}
