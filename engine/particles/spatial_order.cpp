// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/particles/spatial_order.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "engine/support/huge_vector.hpp"

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
void sort_by_upper_half(HugeRoom<std::uint64_t>& numbers, Team& team) {
  constexpr unsigned bits = 11;
  constexpr std::size_t digits = std::size_t{1} << bits;
  using Places = std::array<std::size_t, digits>;
  HugeRoom<std::uint64_t> sorted(numbers.size());
  std::vector<Places> places(team.size());  // of the next number with this digit, for each thread
  for (unsigned shift = 32; shift < 64; shift += bits) {
    const auto digit = [shift](std::uint64_t number) { return number >> shift & (digits - 1); };
    team.run([&](unsigned thread) {
      Places& count = places[thread];
      count = {};
      const std::size_t end = team.part(numbers.size(), thread + 1);
      for (std::size_t k = team.part(numbers.size(), thread); k < end; ++k)
        ++count[digit(numbers[k])];
    });
    std::size_t place = 0;
    for (std::size_t d = 0; d < digits; ++d)
      for (Places& of_thread : places) place += std::exchange(of_thread[d], place);
    team.run([&](unsigned thread) {
      Places& next = places[thread];
      const std::size_t end = team.part(numbers.size(), thread + 1);
      for (std::size_t k = team.part(numbers.size(), thread); k < end; ++k)
        sorted[next[digit(numbers[k])]++] = numbers[k];
    });
    numbers.swap(sorted);
  }
}

// Half a record.
struct alignas(32) Half {
  std::array<std::uint64_t, 4> bits;
};
static_assert(sizeof(Particle) == 2 * sizeof(Half));

}  // namespace

void sort_in_space(std::span<Particle> particles, const Box& box, Team& team) {
  HugeRoom<std::uint64_t> order(particles.size());
  team.for_parts(particles.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      order[k] = place_on_curve(particles[k].position, box) << 32 | k;
  });
  sort_by_upper_half(order, team);

  // The records are moved by halves, because a second copy of the particles would be the largest
  // allocation of a run.
  constexpr std::uint64_t index = 0xffffffff;
  HugeRoom<Half> moved(particles.size());
  char* const records = reinterpret_cast<char*>(particles.data());
  for (const std::size_t half : {std::size_t{0}, sizeof(Half)}) {
    team.for_parts(particles.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        std::memcpy(&moved[k], records + (order[k] & index) * sizeof(Particle) + half,
                    sizeof(Half));
    });
    team.for_parts(particles.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        std::memcpy(records + k * sizeof(Particle) + half, &moved[k], sizeof(Half));
    });
  }
}

}  // namespace haff::engine
