// SPDX-License-Identifier: GPL-3.0-or-later

// Hundreds of flipped bits, each from its seed; tests/cli/store/flipped_bits.cpp has a few.
#include "support/flipped_bits.hpp"

#include <doctest/doctest.h>

using namespace haff::tests;

namespace {

void check(const FlippedBits& result) {
  MESSAGE(result.found, " of ", result.telling, " found, ", result.mended, " repaired, of ",
          result.flips, " flips");
  CHECK(result.found == result.telling);
}

}  // namespace

TEST_CASE("flipped bits: each one in a value is found and repaired") {
  const FlippedBits result = flip_bits(4, 400, BitsOf::values);
  check(result);
  CHECK(result.telling == result.flips);
  CHECK(result.mended == result.telling);
}

TEST_CASE("flipped bits: each one in a half-finished store is found and repaired") {
  const FlippedBits result = flip_bits(5, 200, BitsOf::values, Store::half_run);
  check(result);
  CHECK(result.mended == result.telling);
}

TEST_CASE("flipped bits: verify finds those anywhere that change the content of the store") {
  check(flip_bits(6, 500, BitsOf::anywhere));
}
