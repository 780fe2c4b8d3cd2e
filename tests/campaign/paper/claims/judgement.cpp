// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/paper/claims/judgement.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace haff::campaign;

TEST_CASE(
    "judgement: a value must be nearer to the reference than half the way to the nearest rival") {
  const std::vector<Rival> rivals{{"far", 2}, {"near", 0.9}};
  CHECK(judge(1.04, 0.01, 1, rivals).holds == true);
  CHECK(judge(0.96, 0.01, 1, rivals).holds == true);
  CHECK(judge(1.07, 0.01, 1, rivals).holds == false);
  CHECK(judge(0.90, 0.01, 1, rivals).holds == false);
  CHECK(judge(0.96, 0.01, 1, rivals).criterion.find("near") != std::string::npos);
}

TEST_CASE("judgement: a value with a large error can be refuted, but not confirmed") {
  const std::vector<Rival> rivals{{"near", 0.9}};
  CHECK_FALSE(judge(1.0, 0.06, 1, rivals).holds);
  CHECK_FALSE(judge(1.10, 0.06, 1, rivals).holds);
  CHECK(judge(1.2, 0.06, 1, rivals).holds == false);
  CHECK_FALSE(judge(1.0, std::nan(""), 1, rivals).holds);  // one realization
}

TEST_CASE("judgement: a tolerance is never wider than its stated maximum") {
  CHECK(judge(0.2, 0.01, 0, {{"nothing", 1}}, 0.1).holds == false);
  CHECK(judge(0.05, 0.01, 0, {{"nothing", 1}}, 0.1).holds == true);
}
