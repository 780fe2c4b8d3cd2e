// Elastic below a threshold: spheres that meet slowly part elastically, the others with e.
//
// The simplest cure for inelastic collapse: relative speeds in a collapsing group fall
// geometrically, and stop falling at the threshold. Normal relative speed |n.(v_a - v_b)| <
// `speed` [sqrt(E(0)/m)]: e = 1.
#pragma once

#include <cmath>
#include <string_view>

#include "engine/law.hpp"

namespace haff::engine {

class ElasticThreshold : public Forgetful {
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
  double scaled2_ = 0;  // in units of the scaled velocities, squared
};

}  // namespace haff::engine
