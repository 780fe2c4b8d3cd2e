// SPDX-License-Identifier: GPL-3.0-or-later

// Velocity permutation: the velocities are permuted among the particles at random.
//
// This destroys the spatial correlations of the velocities and keeps their distribution. It tests
// the argument of R. Kawahara and H. Nakanishi, cond-mat/0309130: without correlations, a_2 stays
// at the fixed point of the Enskog-Boltzmann equation, -0.0170 at e = 0.85 by direct simulation
// (-A/B = -0.0153 is first order in a_2). The gas stays 6 % short of this value at n = 0.05 and
// 14 % at n = 0.4: positions are not permuted, and pairs near contact collide again. The
// permutation is done whenever tau is a multiple of `every` [collisions per particle].
#pragma once

#include <string_view>
#include <utility>

#include "engine/actions/action.hpp"

namespace haff::engine {

class Shuffle : public Action {
 public:
  static constexpr std::string_view name = "shuffle";

  Shuffle(const Parameters& parameters, std::uint64_t seed, const State&)
      : every_(positive(parameters, "every")), seed_(seed) {}

  std::int64_t next(std::int64_t collisions, std::size_t particles) const override {
    return next_at(collisions, particles, every_);
  }

  // R. Durstenfeld, Comm. ACM 7, 420 (1964): all permutations have the same probability.
  void act(std::span<Particle> particles, const Clock& clock) override {
    Random random(seed_, Stream::shuffle, static_cast<std::uint64_t>(clock.collisions));
    for (std::size_t left = particles.size(); left > 1; --left)
      std::swap(particles[left - 1].velocity, particles[random.below(left)].velocity);
  }

 private:
  double every_;
  std::uint64_t seed_;
};

}  // namespace haff::engine
