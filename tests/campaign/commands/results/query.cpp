// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/results/query.hpp"

#include <doctest/doctest.h>

#include <limits>

using namespace haff;
using namespace haff::campaign;

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
}

TEST_CASE("query: reals keep all digits and stay reals") {
  CHECK(csv_text(0.1) == "0.10000000000000001");
  CHECK(csv_text(2.0) == "2.0");
  CHECK(json_text(1e300) == "1.0000000000000001e+300");
  CHECK(json_text(-0.0) == "-0.0");
}

TEST_CASE("query: integers have all digits") {
  CHECK(csv_text(std::int64_t{9007199254740993}) == "9007199254740993");
}

TEST_CASE("query: infinity in a form that JSON readers understand") {
  CHECK(json_text(infinity) == "1e999");
  CHECK(json_text(-infinity) == "-1e999");
}

TEST_CASE("query: NULL and an empty text are told apart") {
  CHECK(csv_text(schema::Null{}) == "");
  CHECK(csv_text(std::string()) == "\"\"");
  CHECK(json_text(schema::Null{}) == "null");
  CHECK(json_text(std::string()) == "\"\"");
}

TEST_CASE("query: text is quoted where it must be") {
  CHECK(csv_text(std::string("a,b")) == "\"a,b\"");
  CHECK(csv_text(std::string("say \"x\"")) == "\"say \"\"x\"\"\"");
  CHECK(json_text(std::string("a\n\"b\"")) == R"("a\n\"b\"")");
}

TEST_CASE("query: BLOBs in hexadecimal, short in a table") {
  const schema::Blob blob(20, std::byte{0xab});
  CHECK(csv_text(blob).size() == 40);
  CHECK(table_text(blob).find("... (20 bytes)") != std::string::npos);
}
