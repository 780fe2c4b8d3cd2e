// 500 flipped bits, each with a seed; a few are in the gate (tests/cli/store/flipped_bits.cpp).
#include "support/flipped_bits.hpp"

#include <doctest/doctest.h>

using namespace haff::tests;

TEST_CASE("flipped bits: verify finds those that change what a store says") {
  const FlippedBits result = flip_bits(2, 500);
  MESSAGE(result.found, " of ", result.telling, " found, of ", result.flips, " flips");
  CHECK(result.found == result.telling);
}
