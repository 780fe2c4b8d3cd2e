// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/run/watch.hpp"

#include <doctest/doctest.h>

using namespace haff::campaign;

using Lines = std::vector<std::string>;

TEST_CASE("watch: a text that fits is shown as it is") {
  CHECK(screen_of("a\nbc\n", 10, 5) == Lines{"a", "bc"});
  CHECK(screen_of("", 10, 5).empty());
}

TEST_CASE("watch: lines are cut to the width, between characters") {
  CHECK(screen_of("abcdef\n", 3, 5) == Lines{"abc"});
  CHECK(screen_of("\u03c4\u03c4\u03c4 x\n", 2, 5) == Lines{"\u03c4\u03c4"});
}

TEST_CASE("watch: lines that do not fit are counted") {
  CHECK(screen_of("1\n2\n3\n4\n", 80, 3) == Lines{"1", "2", "... 2 more lines"});
  CHECK(screen_of("1\n2\n3\n", 80, 3) == Lines{"1", "2", "3"});
}

TEST_CASE("watch: text of a store does not move the cursor") {
  CHECK(screen_of("\x1b[2J\n", 80, 3) == Lines{"\\x1b[2J"});
}
