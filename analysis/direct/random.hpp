// SPDX-License-Identifier: GPL-3.0-or-later

// Random numbers of the direct simulation: the same seed gives the same bits on every machine.
//
// xoshiro256++ of D. Blackman and S. Vigna, ACM TOMS 47, 36 (2021). Its state is filled by
// splitmix64, the generator that the authors recommend for this. Each realization has a stream of
// its own. Only integers, + - x / and square roots are used: the distributions of the C++ library
// differ between libraries, as does the last bit of logarithms.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace haff::analysis {

class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t stream) {
    std::uint64_t x = mixed(seed) ^ stream;
    for (auto& word : state_) word = mixed(x += 0x9e3779b97f4a7c15u);
  }

  std::uint64_t bits() {
    auto& [a, b, c, d] = state_;
    const std::uint64_t result = std::rotl(a + d, 23) + a;
    const std::uint64_t shifted = b << 17;
    c ^= a;
    d ^= b;
    b ^= c;
    a ^= d;
    c ^= shifted;
    d = std::rotl(d, 45);
    return result;
  }

  // Uniform in [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  // Exponential with mean 1. J. von Neumann, Nat. Bur. Stand. Appl. Math. Ser. 12, 36 (1951): among
  // falling runs of uniform numbers, those of odd length begin with an x of density exp(-x).
  double exponential() {
    for (double whole = 0;; ++whole) {
      const double first = uniform();
      double last = first;
      bool odd = true;
      for (double next = uniform(); next < last; next = uniform()) {
        last = next;
        odd = !odd;
      }
      if (odd) return whole + first;
    }
  }

  // Two independent standard normal numbers.
  std::array<double, 2> normal() {
    for (;;) {
      const double x = 2 * uniform() - 1, y = 2 * uniform() - 1;
      const double square = x * x + y * y;
      if (square >= 1 || square == 0) continue;
      const double scale = std::sqrt(2 * exponential() / square);
      return {x * scale, y * scale};
    }
  }

  // The number of ones among 64 fair bits, minus its mean, over its standard deviation 4: mean 0,
  // variance 1, excess kurtosis -1/32. The sum of many such numbers is Gaussian.
  double nearly_normal() { return (std::popcount(bits()) - 32) / 4.0; }

 private:
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  std::array<std::uint64_t, 4> state_{};
};

}  // namespace haff::analysis
