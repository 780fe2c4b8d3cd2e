// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/text/command_text.hpp"

#include <doctest/doctest.h>

using namespace haff::campaign;

TEST_CASE("command_text: words are quoted where a shell would split them") {
  CHECK(shell_word("grid.json") == "grid.json");
  CHECK(shell_word("my runs/a b.db") == "'my runs/a b.db'");
  CHECK(shell_word("it's") == "'it'\\''s'");
  CHECK(shell_word("$HOME/*;`id`") == "'$HOME/*;`id`'");
  CHECK(shell_word("") == "''");
  CHECK(shell_word("-x.json") == "./-x.json");
  CHECK(shell_word("~/a") == "'~/a'");
}

TEST_CASE("command_text: the default store is not named") {
  CHECK(command_text("run", "campaign.db") == "campaign run");
  CHECK(command_text("run", "a b.db") == "campaign run --store 'a b.db'");
}
