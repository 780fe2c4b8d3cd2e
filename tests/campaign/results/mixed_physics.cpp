// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/results/mixed_physics.hpp"

#include <doctest/doctest.h>

#include "schema/fixture.hpp"

using namespace haff;
using namespace haff::campaign;

namespace {

// Two realizations of one series, computed with these physics versions.
schema::Store two_realizations(int first, int second) {
  auto store = schema::Store::in_memory();
  store.add(schema::plan({schema::cooling(0.8, 1), schema::cooling(0.8, 2)}));
  schema::equilibrate(store);
  for (const int physics_version : {first, second}) {
    const auto claim = store.claim(schema::me, "test");
    REQUIRE(claim);
    store.finish(
        claim->lease,
        {.checkpoint = schema::Checkpoint{.tau = claim->tau_max, .state = schema::bytes(8)},
         .physics_version = physics_version,
         .progress = {.tau = claim->tau_max}},
        std::nullopt, claim->tau_max);
  }
  return store;
}

}  // namespace

TEST_CASE("realizations of one physics version are averaged without a message") {
  CHECK(mixed_physics(two_realizations(1, 1)).empty());
}

TEST_CASE("realizations of two physics versions are named") {
  const auto sentences = mixed_physics(two_realizations(1, 2));
  REQUIRE(sentences.size() == 1);
  CHECK(sentences[0].find("the 2 realizations of the series of job") != std::string::npos);
  CHECK(sentences[0].find("physics versions 1,2") != std::string::npos);
}
