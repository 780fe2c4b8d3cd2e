// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/particles/spatial_order.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace haff::engine {
namespace {

// The ten lowest bits of x, with two empty places between neighbours.
std::uint64_t spread(std::uint64_t x) {
  x = (x | (x << 16)) & 0x030000ff;
  x = (x | (x << 8)) & 0x0300f00f;
  x = (x | (x << 4)) & 0x030c30c3;
  x = (x | (x << 2)) & 0x09249249;
  return x;
}

std::uint64_t place_on_curve(const Vector& position, const Box& box) {
  std::uint64_t place = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto cell = static_cast<std::int64_t>(position[k] * box.inverse * 1024);
    place |= spread(static_cast<std::uint64_t>(std::clamp<std::int64_t>(cell, 0, 1023))) << k;
  }
  return place;
}

// Sorts by the upper 32 bits; equal ones keep their order. A radix sort, lowest digit first, takes
// a third of the time of a sort by comparisons, in which every second branch is mispredicted.
void sort_by_upper_half(std::vector<std::uint64_t>& numbers) {
  constexpr unsigned bits = 11;
  constexpr std::size_t digits = std::size_t{1} << bits;
  std::vector<std::uint64_t> sorted(numbers.size());
  for (unsigned shift = 32; shift < 64; shift += bits) {
    const auto digit = [shift](std::uint64_t number) { return number >> shift & (digits - 1); };
    std::array<std::size_t, digits + 1> place{};  // of the first number with this digit
    for (const std::uint64_t number : numbers) ++place[digit(number) + 1];
    std::partial_sum(place.begin(), place.end(), place.begin());
    for (const std::uint64_t number : numbers) sorted[place[digit(number)]++] = number;
    numbers.swap(sorted);
  }
}

}  // namespace

void sort_in_space(std::span<Particle> particles, const Box& box) {
  std::vector<std::uint64_t> order(particles.size());
  for (std::size_t k = 0; k < particles.size(); ++k)
    order[k] = place_on_curve(particles[k].position, box) << 32 | k;
  sort_by_upper_half(order);

  // The permutation is done in place, cycle by cycle, because a second copy of the particles would
  // be the largest allocation of a run.
  constexpr std::uint64_t index = 0xffffffff;
  for (std::size_t first = 0; first < particles.size(); ++first) {
    if ((order[first] & index) == first) continue;
    const Particle saved = particles[first];
    std::size_t hole = first;
    for (;;) {
      const std::size_t source = order[hole] & index;
      order[hole] = hole;
      if (source == first) break;
      particles[hole] = particles[source];
      hole = source;
    }
    particles[hole] = saved;
  }
}

}  // namespace haff::engine
