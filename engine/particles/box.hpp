// SPDX-License-Identifier: GPL-3.0-or-later

// The periodic box: a cube of side L; for disks (d = 2) a square.
#pragma once

#include "engine/particles/particle.hpp"

namespace haff::engine {

struct Box {
  explicit Box(double length, int dimension = 3)
      : side(length), inverse(1 / length), d(dimension) {}
  explicit Box(const State& state) : Box(state.box, state.d) {}

  double volume() const { return d == 2 ? side * side : side * side * side; }

  double side;
  double inverse;
  int d;
};

}  // namespace haff::engine
