// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/expected_rate.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "analysis/theory/enskog.hpp"

using namespace haff;
using doctest::Approx;

namespace {

schema::Job gas(double n, const std::string& effects) {
  schema::Job job{.e = 0.9, .n = n, .particles = 1008};
  job.effects = effects;
  return job;
}

}  // namespace

TEST_CASE("expected rate: a mixture of two equal species is a gas of one") {
  const double alone = analysis::transport(0.4, 2.0, 3).collision_rate;
  CHECK(campaign::expected_collision_rate(gas(0.4, "{}"), 2) == alone);
  CHECK(campaign::expected_collision_rate(
            gas(0.4, R"({"mixture":{"diameter_ratio":1,"fraction":0.5,"mass_ratio":1}})"), 2) ==
        Approx(alone).epsilon(1e-12));
}

TEST_CASE("expected rate: a mixture may have more particles in a volume than equal spheres") {
  // pi/6 n is above 1, but most particles are small, and 0.31 of the box is filled. Nearly all
  // particles are small, so the rate is that of small particles alone, with n 0.4^3 = 0.192 in
  // units of their own diameter and mass.
  const double rate = campaign::expected_collision_rate(
      gas(3, R"({"mixture":{"diameter_ratio":0.4,"fraction":0.999,"mass_ratio":0.064}})"), 1);
  const double small = analysis::transport(0.192, 1 / 0.064, 3).collision_rate / 0.4;
  // One particle in a thousand is large, and has 20 times as many collisions.
  CHECK(rate == Approx(small).epsilon(0.02));
}
