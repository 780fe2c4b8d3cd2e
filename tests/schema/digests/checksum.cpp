// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/digests/checksum.hpp"

#include <doctest/doctest.h>

#include <string_view>

#include "schema/fixture.hpp"

using namespace haff::schema;

TEST_CASE("the checksum is FNV-1a with 64 bits") {
  const auto of = [](std::string_view text) {
    return checksum(std::as_bytes(std::span(text.data(), text.size())));
  };
  // Published test vectors (Noll's page of the algorithm).
  CHECK(of("") == 0xcbf29ce484222325);
  CHECK(of("a") == 0xaf63dc4c8601ec8c);
  CHECK(of("foobar") == 0x85944171f73967e8);
}

TEST_CASE("every bit changes the checksum") {
  auto state = bytes(64);
  const auto sum = checksum(state);
  for (std::size_t bit = 0; bit < 8 * state.size(); ++bit) {
    const auto flip = std::byte(1u << (bit % 8));
    state[bit / 8] ^= flip;
    CHECK(checksum(state) != sum);
    state[bit / 8] ^= flip;
  }
}
