// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/text/csv.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace haff::campaign;

TEST_CASE("csv: numbers have all digits, and a missing number is an empty field") {
  CHECK(csv_row(0.1, 7, std::int64_t{-3}) == "0.10000000000000001,7,-3\n");
  CHECK(csv_row(std::nan(""), std::optional<double>(), HUGE_VAL) == ",,\n");
}

TEST_CASE("csv: text is quoted where it must be") {
  CHECK(csv_row("G_parallel, tau = 20", "plain text") == "\"G_parallel, tau = 20\",plain text\n");
  CHECK(csv_row("say \"a\"", "two\nlines", "") == "\"say \"\"a\"\"\",\"two\nlines\",\"\"\n");
}
