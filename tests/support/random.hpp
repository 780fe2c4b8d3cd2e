// SPDX-License-Identifier: GPL-3.0-or-later

// Random numbers of the tests: the same ones with every compiler and on every machine.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace haff::tests {

// splitmix64: G. L. Steele, D. Lea and C. H. Flood, OOPSLA (2014).
inline std::uint64_t random_bits(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// Normal numbers of mean 0 and variance 1, by Box and Muller.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : state_(seed) {}

  // Above 0 and below 1.
  double uniform() { return (static_cast<double>(random_bits(state_) >> 11) + 0.5) * 0x1p-53; }

  double operator()() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  std::uint64_t state_;
};

}  // namespace haff::tests
