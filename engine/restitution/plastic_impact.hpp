// SPDX-License-Identifier: GPL-3.0-or-later

// Plastic spheres, such as metals: they yield at the contact, and more so in faster collisions.
//
// K. L. Johnson, Contact Mechanics (Cambridge, 1985), section 11.5: in fully plastic impacts e
// falls as v^(-1/4) with the normal relative speed v, while below a yield speed spheres deform
// elastically. Joined at the yield `speed` v_y [sqrt(E(0)/m)],
//   e = 1 for v <= v_y,   e = (v_y/v)^(1/4) beyond.
// v_y is proportional to sqrt(R^3/mu), where R is the effective radius and mu the reduced mass of
// the pair: in a mixture `speed` is the value for two particles of species 1, and both species are
// of one material.
#pragma once

#include <cmath>
#include <string_view>

#include "engine/restitution/restitution_model.hpp"

namespace haff::engine {

class PlasticImpact : public Memoryless {
 public:
  static constexpr std::string_view name = "plastic";

  // The model decides e, so the first argument is unused.
  PlasticImpact(double, const Parameters& parameters) : speed_(positive(parameters, "speed")) {}

  // The fourth root is taken as two square roots: IEEE 754 defines every bit of them.
  double operator()(const Impact& impact) const {
    const double speed = std::sqrt(impact.speed2);
    const double yield =
        scaled_ * std::sqrt(impact.radius * impact.radius * impact.radius / impact.mass);
    return speed <= yield ? 1 : std::sqrt(std::sqrt(yield / speed));
  }

  void scale(int exponent) { scaled_ = std::ldexp(speed_, exponent); }

 private:
  double speed_;
  double scaled_ = 0;  // the yield speed in scaled units
};

}  // namespace haff::engine
