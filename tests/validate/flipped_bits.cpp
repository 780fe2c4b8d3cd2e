// SPDX-License-Identifier: GPL-3.0-or-later

// Hundreds of flipped bits, each from a seed; a few are in the gate
// (tests/cli/store/flipped_bits.cpp).
#include "support/flipped_bits.hpp"

#include <doctest/doctest.h>

using namespace haff::tests;

namespace {

void check(const FlippedBits& result) {
  MESSAGE(result.found, " of ", result.telling, " found, ", result.mended, " put right, of ",
          result.flips, " flips");
  CHECK(result.found == result.telling);
}

}  // namespace

TEST_CASE("flipped bits: of values, each is found and put right") {
  const FlippedBits result = flip_bits(4, 400, BitsOf::values);
  check(result);
  CHECK(result.telling == result.flips);
  CHECK(result.mended == result.telling);
}

TEST_CASE("flipped bits: in a store that is half run, each is found and put right") {
  const FlippedBits result = flip_bits(5, 200, BitsOf::values, Store::half_run);
  check(result);
  CHECK(result.mended == result.telling);
}

TEST_CASE("flipped bits: anywhere, verify finds those that change what the store says") {
  check(flip_bits(6, 500, BitsOf::anywhere));
}
