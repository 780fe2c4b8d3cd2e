#include "campaign/checkpoint.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "engine/initial.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

engine::State a_state() {
  engine::State state = engine::initial_state(0.4, 100, 1);
  state.exponent = -3;
  state.collisions = 123456789012;
  state.time = 0.1;
  state.tally = {.dissipated = 1.5, .virial = -0.0};
  state.momentum_removed = 1e-17;
  return state;
}

}  // namespace

TEST_CASE("checkpoint: decode gives back what encode was given") {
  CHECK(decode(encode(a_state())) == a_state());
}

TEST_CASE("checkpoint: the sign of zero is kept") {
  CHECK(std::signbit(decode(encode(a_state())).tally.virial));
}

TEST_CASE("checkpoint: bytes begin with the name of the format") {
  CHECK(std::memcmp(encode(a_state()).data(), "HAFFGAS\n", 8) == 0);
}

TEST_CASE("checkpoint: equal states have equal bytes") {
  CHECK(encode(a_state()) == encode(a_state()));
}

TEST_CASE("checkpoint: any changed bit is found") {
  auto bytes = encode(a_state());
  for (std::size_t place = 0; place < bytes.size(); place += 7)
    for (int bit = 0; bit < 8; bit += 3) {
      CAPTURE(place);
      bytes[place] ^= std::byte{1} << bit;
      CHECK_THROWS_AS(decode(bytes), DamagedCheckpoint);
      bytes[place] ^= std::byte{1} << bit;
    }
}

TEST_CASE("checkpoint: any cut is found") {
  const auto bytes = encode(a_state());
  for (std::size_t size = 0; size < bytes.size(); size += 13)
    CHECK_THROWS_AS(decode(std::span(bytes).first(size)), DamagedCheckpoint);
}

TEST_CASE("checkpoint: bytes added are found") {
  auto bytes = encode(a_state());
  bytes.resize(bytes.size() + 8);
  CHECK_THROWS_AS(decode(bytes), DamagedCheckpoint);
}
