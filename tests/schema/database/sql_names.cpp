// SPDX-License-Identifier: GPL-3.0-or-later

// Names in an SQL expression, and their replacement.
#include "schema/database/sql_names.hpp"

#include <doctest/doctest.h>

using namespace haff::schema;

TEST_CASE("names are words outside quotes, but not numbers and functions") {
  CHECK(names_in("sqrt(a2) + 1e-3*roughness.beta AND law = 'tc'") ==
        std::vector<std::string>{"a2", "roughness.beta", "AND", "law"});
  CHECK(names_in("") == std::vector<std::string>{});
  CHECK(names_in("'it''s N' = \"N\" || .5") == std::vector<std::string>{});
  CHECK(names_in("'N") == std::vector<std::string>{});  // a quote that is not closed
}

TEST_CASE("names are replaced, and the rest stays as it is") {
  const auto in_brackets = [](std::string_view name) { return "<" + std::string(name) + ">"; };
  CHECK(with_names("abs(n - .4) < 1E-4 AND 'n'", in_brackets) == "abs(<n> - .4) < 1E-4 <AND> 'n'");
}
