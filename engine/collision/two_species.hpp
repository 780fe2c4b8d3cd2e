// SPDX-License-Identifier: GPL-3.0-or-later

// The pair geometry of a binary mixture (mixture.hpp): two particles touch at the distance sigma_ab
// = (sigma_a + sigma_b)/2. With equal species every bit is that of HardSpheres.
#pragma once

#include <stdexcept>

#include "engine/collision/pair_geometry.hpp"
#include "engine/mixture.hpp"
#include "engine/simulation.hpp"

namespace haff::engine {

class TwoSpecies {
 public:
  // For the mixture that the model asks for. Throws std::invalid_argument as mixture_of() does.
  TwoSpecies(const Model& model, const State& start)
      : mixture_(mixture_of(model.effects.at("mixture"), start.particles())) {}

  double contact_time(const Encounter& pair, const Particle& a, const Particle& b) const {
    const double approach = dot(pair.r, pair.v);
    const double gap = dot(pair.r, pair.r) - contact2(a, b);
    const double discriminant = approach * approach - dot(pair.v, pair.v) * gap;
    if (!(approach < -smallest_approach && discriminant >= 0)) return never;
    return pair.start + std::max(gap, 0.0) / (std::sqrt(discriminant) - approach);
  }
  double contact2(const Particle& a, const Particle& b) const { return contact2(a.id, b.id); }
  // contact2() of a and any particle of species 1 or 2.
  double contact2_with_first(const Particle& a) const { return contact2(a.id, 0); }
  double contact2_with_second(const Particle& a) const { return contact2(a.id, mixture_.first); }
  double effective_radius(const Particle& a, const Particle& b) const {
    const double of_a = mixture_.diameter_of(a.id), of_b = mixture_.diameter_of(b.id);
    return 2 * of_a * of_b / (of_a + of_b);
  }
  MixedMasses masses() const { return {mixture_}; }

  void recall(const State& state) {
    if (mixture_in(state) != mixture_)
      throw std::invalid_argument("the state is not of the mixture that the model asks for");
  }
  void store(State& state) const { note(mixture_, state); }

  const Mixture& mixture() const { return mixture_; }

 private:
  double contact2(std::uint32_t a, std::uint32_t b) const {
    const double distance = mixture_.contact_distance(a, b);
    return distance * distance;
  }

  Mixture mixture_;
};

}  // namespace haff::engine
