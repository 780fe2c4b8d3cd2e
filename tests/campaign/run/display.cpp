// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/run/display.hpp"

#include <doctest/doctest.h>

using namespace haff::campaign;

namespace {

const std::vector<std::optional<ProgressReport>> workers{
    ProgressReport{7, "cooling e=0.8 n=0.4 N=500 seed 1", 45, 90, 1.25e6}, std::nullopt};

const Totals totals{.jobs = 12, .done = 5, .failed = 1, .fraction = 0.432, .seconds_left = 200};

}  // namespace

TEST_CASE("display: a bar for each worker, and one for the whole run") {
  const auto lines = bars(workers, totals, 200, 24);
  REQUIRE(lines.size() == 3);
  CHECK(lines[0] ==
        "[##########..........] tau   45.0/90     1.25 M collisions/s  "
        "job 7 cooling e=0.8 n=0.4 N=500 seed 1");
  CHECK(lines[1] == "[....................] waiting");
  CHECK(lines[2] == "[#########...........]  43.2 %  5 of 12 jobs done, 1 failed, 3m 20s left");
}

TEST_CASE("display: no line is wider than the terminal") {
  for (const std::string& line : bars(workers, totals, 30, 24)) CHECK(line.size() <= 30);
}

TEST_CASE("display: one plain line has the same content") {
  CHECK(plain_line(workers, totals) ==
        " 43.2 %  5 of 12 jobs done, 1 failed, 3m 20s left,  1.25 M collisions/s; "
        "job 7 tau 45.0/90");
  const std::vector<std::optional<ProgressReport>> begun{
      ProgressReport{8, "cooling e=0.8 n=0.4 N=500 seed 2", 0, 90, 0}};
  CHECK(plain_line(begun, totals) ==
        " 43.2 %  5 of 12 jobs done, 1 failed, 3m 20s left; job 8 tau 0.0/90");
}
