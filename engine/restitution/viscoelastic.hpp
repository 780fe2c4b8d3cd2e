// SPDX-License-Identifier: GPL-3.0-or-later

// Viscoelastic spheres: the faster a collision, the less elastic it is.
//
// R. Ramirez, T. Poeschel, N. V. Brilliantov, T. Schwager, PRE 60, 4465 (1999), eq. (22): with the
// normal relative speed v and x = C_1 A v^(1/5),
//   e = 1 - x + (3/5) x^2,   C_1 = 1.15344,
// where A includes the elastic constant [(sqrt(E(0)/m))^(-1/5)]. A is proportional to
// (sqrt(R)/mu)^(2/5), where R is the effective radius and mu the reduced mass of the pair: in a
// mixture A is the value for two particles of species 1, and both species are of one material. The
// series has its minimum, 0.583, at x = 5/6 and returns to 1 at x = 5/3; beyond that it does not
// describe spheres. A gas of viscoelastic spheres cools as T ~ t^(-5/3).
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "engine/restitution/restitution_model.hpp"

namespace haff::engine {

// x^(1/5) of a normal number x > 0, with a relative error of some 1e-16. Only + * / are used, so
// IEEE 754 defines every bit. The bits of a double, read as an integer, are nearly its logarithm: a
// fifth of that integer is within 7 % of the root. Three steps of Halley's method suffice, each of
// which cubes the relative error and halves it.
inline double fifth_root(double x) {
  constexpr std::uint64_t four_fifths_of_one = 0x3ff0000000000000 / 5 * 4;
  double root = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) / 5 + four_fifths_of_one);
  for (int step = 0; step < 3; ++step) {
    const double square = root * root;
    const double fifth = square * square * root;
    root *= (2 * fifth + 3 * x) / (3 * fifth + 2 * x);
  }
  return root;
}

class Viscoelastic : public Memoryless {
 public:
  static constexpr std::string_view name = "viscoelastic";

  // The model decides e, so the first argument is unused.
  Viscoelastic(double, const Parameters& parameters) : strength_(c1 * positive(parameters, "A")) {}

  double operator()(const Impact& impact) const {
    const double softness = impact.radius / (impact.mass * impact.mass);
    const double x = scaled_ * fifth_root(std::sqrt(impact.speed2) * remainder_ * softness);
    if (x > 5.0 / 3) [[unlikely]]
      too_fast(impact);
    return 1 - x + 0.6 * (x * x);
  }

  // v^(1/5) in true units: a fifth of the exponent goes in front of the root; the remainder stays
  // under the root.
  void scale(int exponent) {
    const int left = (exponent % 5 + 5) % 5;
    remainder_ = std::ldexp(1.0, -left);
    scaled_ = std::ldexp(strength_, -(exponent - left) / 5);
  }

 private:
  static constexpr double c1 = 1.15344;

  [[noreturn, gnu::noinline]] static void too_fast(const Impact& impact) {
    throw PhysicsError("particles " + std::to_string(impact.a.id) + " and " +
                       std::to_string(impact.b.id) +
                       " met so fast that the viscoelastic model gives e > 1: choose a smaller A");
  }

  double strength_;       // C_1 A
  double scaled_ = 0;     // the same for scaled velocities, except for ...
  double remainder_ = 1;  // ... this power of two
};

}  // namespace haff::engine
