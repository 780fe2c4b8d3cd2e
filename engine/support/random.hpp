// SPDX-License-Identifier: GPL-3.0-or-later

// Portable random numbers: the same seed gives the same bits on every machine.
//
// Every use has a stream of its own, named here, so that a new use never changes the numbers of
// another. The distributions of std:: are not used, as their output differs between libraries.
#pragma once

#include <cstdint>

namespace haff::engine {

enum class Stream : std::uint64_t {
  velocities = 1,
  growth = 2,
  shuffle = 3,
  thermostat = 4,
  mixture = 5
};

// xoshiro256** (D. Blackman and S. Vigna, ACM TOMS 47, 36 (2021)), seeded by splitmix64.
class Random {
 public:
  // `part` distinguishes repeated uses of a stream, for example by the collision number, so that
  // the generator need not be stored between two uses.
  Random(std::uint64_t seed, Stream stream, std::uint64_t part = 0) {
    std::uint64_t x = seed ^ (static_cast<std::uint64_t>(stream) * 0xd1342543de82ef95u);
    if (part != 0) x = split_mix(x) ^ part;
    for (auto& word : state_) word = split_mix(x);
  }

  std::uint64_t bits() {
    const std::uint64_t result = rotate(state_[1] * 5, 7) * 9;
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = rotate(state_[3], 45);
    return result;
  }

  // Uniform in [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  // Uniform in 0 ... count - 1: the remainder of a number drawn below a multiple of count.
  std::uint64_t below(std::uint64_t count) {
    const std::uint64_t surplus = (0 - count) % count;  // 2^64 mod count
    std::uint64_t drawn = bits();
    while (drawn < surplus) drawn = bits();
    return drawn % count;
  }

  // Standard normal, by C. F. F. Karney's algorithm N (ACM TOMS 42, 3 (2016)). The algorithm only
  // compares uniform deviates, so it needs no logarithm, whose last bit differs between libraries.
  double normal() {
    for (;;) {
      int whole = 0;  // with probability ~ exp(-whole/2)
      while (accept_exp(0.5)) ++whole;
      bool accepted = true;  // thinned to exp(-whole^2/2)
      for (int k = whole * (whole - 1); accepted && k > 0; --k) accepted = accept_exp(0.5);
      if (!accepted) continue;
      const double fraction = uniform();
      const double exponent = fraction * (2 * whole + fraction) / (2 * whole + 2);
      for (int k = 0; accepted && k <= whole; ++k) accepted = accept_exp(exponent);
      if (!accepted) continue;
      return (bits() >> 63) != 0 ? whole + fraction : -(whole + fraction);
    }
  }

 private:
  // True with the probability exp(-p), 0 <= p <= 1: the probability that a descending run of
  // uniform deviates that starts below p has an even length (J. von Neumann, 1951).
  bool accept_exp(double p) {
    bool even = true;
    for (double last = p, u = uniform(); u < last; u = uniform()) {
      last = u;
      even = !even;
    }
    return even;
  }

  static std::uint64_t rotate(std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }

  static std::uint64_t split_mix(std::uint64_t& x) {
    std::uint64_t z = (x += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  std::uint64_t state_[4];
};

}  // namespace haff::engine
