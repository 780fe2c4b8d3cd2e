// SPDX-License-Identifier: GPL-3.0-or-later

// Conditions and choices without a branch.
//
// Which of two events is earlier, or which list an event goes to, is as good as random: a branch on
// it is mispredicted every second time, and everything after it waits. Such a choice is better
// computed than branched on. The compiler cannot know which choices these are; the functions here
// tell it.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

namespace haff::engine {

// Whether all conditions are true, without a branch.
template <class... Condition>
[[gnu::always_inline]] inline bool all_of(Condition... condition) {
  int all = (int{condition} & ...);
  asm("" : "+r"(all));  // hides from the compiler what `all` depends on
  return all != 0;
}

// condition ? one : other, without a branch.
template <class T>
[[gnu::always_inline]] inline T choose(bool condition, T one, T other) {
  // NOLINTBEGIN(bugprone-sizeof-expression): T may be a pointer, whose bits are chosen
  using Bits = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
  static_assert(sizeof(T) == sizeof(Bits));
  // NOLINTEND(bugprone-sizeof-expression)
  Bits all_ones = 0 - Bits{condition};
  asm("" : "+r"(all_ones));
  return std::bit_cast<T>((std::bit_cast<Bits>(one) & all_ones) |
                          (std::bit_cast<Bits>(other) & ~all_ones));
}

}  // namespace haff::engine
