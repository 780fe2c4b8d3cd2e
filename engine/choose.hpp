// Which of two is earlier, which list an event goes to: conditions as good as random are predicted
// wrong every second time, and all that comes after waits until they are known. Such a choice is
// better computed than branched on. Compilers do not know which ones are; here they are told.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

namespace haff::engine {

// All conditions are true, found without a branch.
template <class... Condition>
[[gnu::always_inline]] inline bool all_of(Condition... condition) {
  int all = (int{condition} & ...);
  asm("" : "+r"(all));  // the compiler knows nothing about it
  return all != 0;
}

// condition ? one : other, without a branch.
template <class T>
[[gnu::always_inline]] inline T choose(bool condition, T one, T other) {
  using Bits = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
  static_assert(sizeof(T) == sizeof(Bits));
  Bits all_ones = 0 - Bits{condition};
  asm("" : "+r"(all_ones));
  return std::bit_cast<T>((std::bit_cast<Bits>(one) & all_ones) |
                          (std::bit_cast<Bits>(other) & ~all_ones));
}

}  // namespace haff::engine
