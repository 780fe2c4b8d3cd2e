// SPDX-License-Identifier: GPL-3.0-or-later

// The time of a contact, where rounding decides whether two spheres touch.
#include "engine/collision/pair_geometry.hpp"

#include <doctest/doctest.h>

using namespace haff::engine;

namespace {

const Box box(10);

// The time at which two spheres meet head-on. They are `distance` apart, and `velocity` is their
// relative velocity along the line between their centres.
double contact_time(double distance, double velocity) {
  const Particle a{.position = {5, 5, 5}, .time = 0, .velocity = {}, .id = 0, .changes = 0};
  const Particle b{.position = {5 + distance, 5, 5},
                   .time = 0,
                   .velocity = {velocity, 0, 0},
                   .id = 1,
                   .changes = 0};
  return HardSpheres::contact_time(Encounter(a, b, 0, box), a, b);
}

}  // namespace

TEST_CASE("pair geometry: spheres that approach meet where they touch") {
  CHECK(contact_time(2, -0.5) == 2);
  CHECK(contact_time(2, 0.5) == never);
  CHECK(contact_time(1, -1) == 0);
}

TEST_CASE("pair geometry: an overlapping pair that approaches meets at once, and others do not") {
  const double overlapping = 1 - 1e-12;
  CHECK(contact_time(overlapping, -1) == 0);
  CHECK(contact_time(overlapping, 1) == never);
}

TEST_CASE("pair geometry: an approach within rounding does not count") {
  // r.v is a sum of three products of numbers of order one: its rounding error is some 1e-15.
  CHECK(contact_time(1, -1e-15) == never);
  CHECK(contact_time(1 - 1e-15, -1e-15) == never);
  // A real approach, however slow, ends in a contact.
  CHECK(contact_time(1, -1e-13) == 0);
}
