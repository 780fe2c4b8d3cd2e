// Single flipped bits in the file of a store that holds every effect and observable: each that
// changes what the store says is found by `campaign verify`.
#pragma once

#include <cstdint>

namespace haff::tests {

struct FlippedBits {
  int flips = 0;
  int telling = 0;  // those that change what the store says, or make it unreadable
  int found = 0;    // of these, by verify
};

// So many flips, each in a fresh copy of the store, at places that the seed decides. A flip that is
// not found is a failure of the test that calls, with byte and bit.
FlippedBits flip_bits(std::uint64_t seed, int flips);

}  // namespace haff::tests
