// SPDX-License-Identifier: GPL-3.0-or-later

// Gases that can be prepared, and the message for those that cannot.
#include "campaign/planning/preparation.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "engine/initial.hpp"

using namespace haff;
using campaign::why_not_prepared;

namespace {

schema::Preparation spheres(double n, std::uint32_t particles) {
  return {3, n, particles, n * std::numbers::pi / 6, false};
}

schema::Preparation disks(double n, std::uint32_t particles) {
  return {2, n, particles, n * std::numbers::pi / 4, false};
}

}  // namespace

TEST_CASE(
    "preparation: a gas that neither a lattice nor growth can make is refused with the nearest N") {
  CHECK(why_not_prepared(disks(1.1, 31)).value() ==
        "disks at n = 1.1 fill 0.86 of their box: no lattice holds them, and disks that grow from "
        "random points jam before; expected N = 30 or 54, which fill a lattice, or a smaller n");
  CHECK(why_not_prepared(disks(1.1, 100)));
  CHECK(why_not_prepared(spheres(1.3, 501)).value().find("N = 500 or 795") != std::string::npos);
  CHECK_FALSE(why_not_prepared(disks(1.1, 30)));
  CHECK_FALSE(why_not_prepared(spheres(1.3, 500)));
  CHECK_FALSE(why_not_prepared(spheres(0.4, 501)));
  CHECK_FALSE(why_not_prepared({3, 1.3, 501, 0.07, true}));
}

TEST_CASE("preparation: gases that are accepted can be grown") {
  // The densest gases without a lattice, of several sizes.
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    CHECK_FALSE(why_not_prepared(spheres(1.2, 501)));
    CHECK_NOTHROW(engine::initial_state(1.2, 501, seed));
    for (const std::uint32_t particles : {31U, 101U}) {
      CHECK_FALSE(why_not_prepared(disks(1.04, particles)));
      CHECK_NOTHROW(engine::initial_state(1.04, particles, seed, 2));
    }
  }
}
