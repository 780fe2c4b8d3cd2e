// SPDX-License-Identifier: GPL-3.0-or-later

// The definition of a store, as one text that commands compare.
#include "schema/sql/definition.hpp"

#include <doctest/doctest.h>

#include "schema/sql/scripts.hpp"

using namespace haff::schema;

TEST_CASE("the definition found at build time is the one that the scripts make") {
  CHECK(newest_definition() == in_one_text(definition_made_by(scripts())));
}

TEST_CASE("two definitions have one text only if they are equal") {
  const Object table{.type = "table", .table = "a", .sql = "CREATE TABLE a (x)"};
  const Object index{.type = "index", .table = "a", .sql = "CREATE INDEX b ON a (x)"};
  const std::string both = in_one_text({{"a", table}, {"b", index}});
  CHECK(both != in_one_text({{"a", table}}));
  // One object whose SQL holds the text of the other.
  Object smuggler = table;
  smuggler.sql += both.substr(in_one_text({{"a", table}}).size() - 1);
  CHECK(both != in_one_text({{"a", smuggler}}));
}
