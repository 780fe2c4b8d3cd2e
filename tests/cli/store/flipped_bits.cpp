// A few flipped bits in the gate; 500 of them in tests/validate/flipped_bits.cpp.
#include "support/flipped_bits.hpp"

#include <doctest/doctest.h>

using namespace haff::tests;

TEST_CASE("flipped bits: verify finds those that change what a store says") {
  const FlippedBits result = flip_bits(1, 25);
  MESSAGE(result.found, " of ", result.telling, " found, of ", result.flips, " flips");
  CHECK(result.found == result.telling);
}
