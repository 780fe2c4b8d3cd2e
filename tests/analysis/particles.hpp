// SPDX-License-Identifier: GPL-3.0-or-later

// Particles without physics, for the tests of observables.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "analysis/observables/mesh.hpp"

namespace haff::analysis {

// splitmix64: the same numbers everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double uniform() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (static_cast<double>((z ^ (z >> 31)) >> 11) + 0.5) * 0x1p-53;
  }
  double gaussian() {
    return std::sqrt(-2 * std::log(uniform())) * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  std::uint64_t state_;
};

// Random positions in the box; particles may overlap.
inline std::vector<Vector> random_positions(std::size_t count, double box, Random& random) {
  std::vector<Vector> position(count);
  for (Vector& r : position)
    for (double& x : r) x = box * random.uniform();
  return position;
}

// Gaussian velocities of temperature 1.
inline std::vector<Vector> thermal_velocities(std::size_t count, Random& random) {
  std::vector<Vector> velocity(count);
  for (Vector& v : velocity)
    for (double& component : v) component = random.gaussian();
  return velocity;
}

// One particle in the middle of each of cells^d cells.
inline std::vector<Vector> lattice(int cells, double box, int d) {
  std::vector<Vector> position;
  const auto middle = [&](int i) { return (i + 0.5) * box / cells; };
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < (d == 3 ? cells : 1); ++k)
        position.push_back({middle(i), middle(j), d == 3 ? middle(k) : 0});
  return position;
}

}  // namespace haff::analysis
