// Velocities are handed out anew: a random permutation of them over the particles.
//
// Destroys the correlations of velocities in space and keeps their distribution, as R. Kawahara and
// H. Nakanishi, cond-mat/0309130, argue with: without correlations a_2 stays on its
// Enskog-Boltzmann plateau. Done whenever tau is a multiple of `every` [collisions per particle].
#pragma once

#include <string_view>
#include <utility>

#include "engine/action.hpp"

namespace haff::engine {

class Shuffle : public Action {
 public:
  static constexpr std::string_view name = "shuffle";

  Shuffle(const Parameters& parameters, std::uint64_t seed, const State&)
      : every_(positive(parameters, "every")), seed_(seed) {}

  std::int64_t next(std::int64_t collisions, std::size_t particles) const override {
    return next_at(collisions, particles, every_);
  }

  // R. Durstenfeld, Comm. ACM 7, 420 (1964): every permutation is as likely as any other.
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
