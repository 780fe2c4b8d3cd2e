// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/text/text_table.hpp"

#include <doctest/doctest.h>

#include "campaign/base/text/number_text.hpp"

using namespace haff::campaign;

TEST_CASE("text table: columns as wide as they need") {
  TextTable table({{"name", Align::left}, {"x"}});
  table.add({"a", "1.25"});
  table.add({"longer", "10"});
  CHECK(table.text() == "name       x\n------  ----\na       1.25\nlonger    10\n");
}

TEST_CASE("text table: letters of more than one byte count once") {
  TextTable table({{"x"}, {"y"}});
  table.add({"1 ± 2", "3"});
  table.add({"1", "2"});
  CHECK(table.text() == "    x  y\n-----  -\n1 ± 2  3\n    1  2\n");
}

TEST_CASE("text table: thousands are separated") {
  CHECK(count_text(0) == "0");
  CHECK(count_text(999) == "999");
  CHECK(count_text(32000) == "32 000");
  CHECK(count_text(-1234567) == "-1 234 567");
}

TEST_CASE("text table: bytes in three digits") {
  CHECK(bytes_text(12) == "12 B");
  CHECK(bytes_text(3.334e6) == "3.33 MB");
  CHECK(bytes_text(999.6) == "1 kB");
}
