// Viscoelastic spheres: the faster they meet, the less elastically they part.
//
// R. Ramirez, T. Poeschel, N. V. Brilliantov, T. Schwager, PRE 60, 4465 (1999), eq. (22): with the
// normal relative speed v and x = C_1 A v^(1/5),
//   e = 1 - x + (3/5) x^2,   C_1 = 1.15344,
// where A has taken up the elastic constant [(sqrt(E(0)/m))^(-1/5)]. That is in proportion to
// (sqrt(R)/mu)^(2/5), R the effective radius and mu the reduced mass of the pair: in a mixture A is
// that of two of species 1, and both species are of one material. The series has its minimum,
// 0.583, at x = 5/6, and returns to 1 at 5/3: beyond it says nothing about spheres.
// A gas of them cools as T ~ t^(-5/3).
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "engine/law.hpp"

namespace haff::engine {

// x^(1/5) of a normal number x > 0, by + * / alone, whose every bit IEEE 754 defines; good to some
// 1e-16. The bits of a double are nearly its logarithm: a fifth of them is within 7 % of the root.
// Three steps of Halley's method, which cube the relative error and halve it, are what it takes.
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

class Viscoelastic : public Forgetful {
 public:
  static constexpr std::string_view name = "viscoelastic";

  // There is no e to choose.
  Viscoelastic(double, const Parameters& parameters) : strength_(c1 * positive(parameters, "A")) {}

  double operator()(const Impact& impact) const {
    const double softness = impact.radius / (impact.mass * impact.mass);
    const double x = scaled_ * fifth_root(std::sqrt(impact.speed2) * remainder_ * softness);
    if (x > 5.0 / 3) [[unlikely]]
      too_fast(impact);
    return 1 - x + 0.6 * (x * x);
  }

  // v^(1/5) in true units: of the exponent a fifth, what is left goes under the root.
  void scale(int exponent) {
    const int left = (exponent % 5 + 5) % 5;
    remainder_ = std::ldexp(1.0, -left);
    scaled_ = std::ldexp(strength_, -(exponent - left) / 5);
  }

 private:
  static constexpr double c1 = 1.15344;

  [[noreturn, gnu::noinline]] static void too_fast(const Impact& impact) {
    throw Breakdown("particles " + std::to_string(impact.a.id) + " and " +
                    std::to_string(impact.b.id) +
                    " met so fast that the viscoelastic law gives e > 1; A is too large");
  }

  double strength_;       // C_1 A
  double scaled_ = 0;     // the same in units of the scaled velocities, but for ...
  double remainder_ = 1;  // ... this power of two
};

}  // namespace haff::engine
