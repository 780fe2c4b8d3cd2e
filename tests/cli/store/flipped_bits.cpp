// SPDX-License-Identifier: GPL-3.0-or-later

// A few flipped bits in the gate; hundreds of them in tests/validate/flipped_bits.cpp.
#include "support/flipped_bits.hpp"

#include <doctest/doctest.h>

using namespace haff::tests;

TEST_CASE("flipped bits: each one in a value is found and repaired") {
  const FlippedBits result = flip_bits(1, 12, BitsOf::values);
  CHECK(result.telling == result.flips);
  CHECK(result.found == result.telling);
  CHECK(result.mended == result.telling);
}

TEST_CASE("flipped bits: each one in a half-finished store is found and repaired") {
  const FlippedBits result = flip_bits(2, 8, BitsOf::values, Store::half_run);
  CHECK(result.found == result.telling);
  CHECK(result.mended == result.telling);
}

TEST_CASE("flipped bits: verify finds those anywhere that change the content of the store") {
  const FlippedBits result = flip_bits(3, 25, BitsOf::anywhere);
  CHECK(result.found == result.telling);
}
