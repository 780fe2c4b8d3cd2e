// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/text/duration.hpp"

#include <doctest/doctest.h>

using namespace haff::campaign;

TEST_CASE("duration: the usual notations are read") {
  CHECK(seconds_from_text("90") == 90);
  CHECK(seconds_from_text("90s") == 90);
  CHECK(seconds_from_text("45m") == 2700);
  CHECK(seconds_from_text("1h30m") == 5400);
  CHECK(seconds_from_text("2d") == 172800);
  CHECK(seconds_from_text("0.5h") == 1800);
}

TEST_CASE("duration: other texts are refused") {
  for (const char* text : {"", "h", "1x", "-5m", "0", "1h-5m", "inf", "nan", "1e400h"}) {
    CAPTURE(text);
    CHECK_FALSE(seconds_from_text(text));
  }
}

TEST_CASE("duration: a duration is written with at most two units") {
  CHECK(duration_text(0) == "0 s");
  CHECK(duration_text(0.034) == "0.03 s");
  CHECK(duration_text(4.21) == "4.2 s");
  CHECK(duration_text(42.4) == "42 s");
  CHECK(duration_text(200) == "3m 20s");
  CHECK(duration_text(7500) == "2h 05m");
  CHECK(duration_text(100000) == "1d 03h");
}
