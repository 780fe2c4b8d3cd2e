// SPDX-License-Identifier: GPL-3.0-or-later

// The TC model of S. Luding and S. McNamara, Granular Matter 1, 113 (1998), cond-mat/9810009: a
// real contact takes some time, so a sphere that touched another one less than t_c ago is still
// deformed.
//
// A collision is elastic if the previous collision of either partner was less than t_c ago
// [sigma sqrt(m/E(0))]; otherwise its restitution coefficient is e. In an inelastic collapse the
// intervals between collisions fall below any t_c, and no more energy is lost.
#pragma once

#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "engine/restitution/restitution_model.hpp"

namespace haff::engine {

class ContactDuration {
 public:
  static constexpr std::string_view name = "tc";

  ContactDuration(double e, const Parameters& parameters)
      : e_(e), duration_(positive(parameters, "t_c")) {}

  double operator()(const Impact& impact) const {
    const bool still_touching =
        impact.now - last(impact.a) < scaled_ || impact.now - last(impact.b) < scaled_;
    return still_touching ? 1 : e_;
  }

  void recall(const State& state) {
    const auto found = state.memory.find(key);
    last_.assign(state.id.size(), -std::numeric_limits<double>::infinity());
    exponent_ = state.exponent;
    if (found == state.memory.end()) return;
    if (found->second.size() != last_.size())
      throw std::invalid_argument("the state remembers contacts of other particles");
    last_ = found->second;
  }
  void store(State& state) const { state.memory[key] = last_; }

  void before_synchronization(std::span<const Particle> particles, double now) {
    for (const Particle& p : particles) last_[p.id] = last(p) - now;
  }

  void scale(int exponent) {
    if (exponent != exponent_)
      for (double& time : last_) time = std::ldexp(time, exponent_ - exponent);
    exponent_ = exponent;
    scaled_ = std::ldexp(duration_, -exponent);
  }

 private:
  static constexpr const char* key = "last_contact";

  // If a particle has collided since the synchronization, the time of its record is that of its
  // last collision.
  double last(const Particle& p) const { return p.changes > 0 ? p.time : last_[p.id]; }

  double e_;
  double duration_;           // t_c
  double scaled_ = 0;         // t_c in scaled time
  int exponent_ = 0;          // of the scaled time
  std::vector<double> last_;  // by id: time of the last contact before the last synchronization,
                              // relative to that synchronization, in scaled units; -infinity if
                              // there was none
};

}  // namespace haff::engine
