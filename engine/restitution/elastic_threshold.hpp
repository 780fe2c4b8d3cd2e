// SPDX-License-Identifier: GPL-3.0-or-later

// A threshold of speed: slow collisions are elastic; all others have the restitution coefficient e.
//
// This is the simplest cure for inelastic collapse: the relative speeds in a collapsing group fall
// geometrically, and stop falling at the threshold. A collision is elastic if its normal relative
// speed |n.(v_a - v_b)| is less than `speed` [sqrt(E(0)/m)].
#pragma once

#include <cmath>
#include <string_view>

#include "engine/restitution/restitution_model.hpp"

namespace haff::engine {

class ElasticThreshold : public Memoryless {
 public:
  static constexpr std::string_view name = "threshold";

  ElasticThreshold(double e, const Parameters& parameters)
      : e_(e), speed_(positive(parameters, "speed")) {}

  double operator()(const Impact& impact) const { return impact.speed2 < scaled2_ ? 1 : e_; }

  void scale(int exponent) {
    const double scaled = std::ldexp(speed_, exponent);
    scaled2_ = scaled * scaled;
  }

 private:
  double e_;
  double speed_;
  double scaled2_ = 0;  // the squared speed in scaled units
};

}  // namespace haff::engine
