// SPDX-License-Identifier: GPL-3.0-or-later

// A user's SQL: it returns typed values and does not write.
#include "schema/database/query.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "schema/fixture.hpp"

using namespace haff::schema;

namespace {

std::string refusal_of(const Reader& reader, const std::string& sql) {
  return refusal([&] {
    Query query = reader.query(sql);
    while (query.next()) {
    }
  });
}

}  // namespace

TEST_CASE("a query returns names and typed values") {
  const TemporaryFolder folder;
  Store::create(folder / "a.db");
  const Reader reader(folder / "a.db");
  Query query =
      reader.query("SELECT NULL AS a, 9007199254740993 AS b, 0.1 AS c, 'x' AS d, x'00ff'");
  CHECK(query.columns() == std::vector<std::string>{"a", "b", "c", "d", "x'00ff'"});
  CHECK(query.next() == Row{Null{}, std::int64_t{9007199254740993}, 0.1, std::string("x"),
                            Blob{std::byte{0}, std::byte{0xff}}});
  CHECK_FALSE(query.next());
  CHECK_FALSE(query.next());
}

TEST_CASE("a query without rows still has columns") {
  const TemporaryFolder folder;
  Store::create(folder / "a.db");
  const Reader reader(folder / "a.db");
  Query query = reader.query("SELECT job_id, e FROM jobs;  -- none yet");
  CHECK(query.columns() == std::vector<std::string>{"job_id", "e"});
  CHECK_FALSE(query.next());
}

TEST_CASE("wrong SQL is refused with SQLite's reason") {
  const Store store = Store::in_memory();
  CHECK(refusal_of(store, "SELEC 1") == "SQL: near \"SELEC\": syntax error");
  CHECK(refusal_of(store, "SELECT f FROM jobs") == "SQL: no such column: f");
  CHECK(refusal_of(store, "SELECT 1 FROM gas") == "SQL: no such table: gas");
  CHECK(refusal_of(store, "") == "SQL: there is no statement");
  CHECK(refusal_of(store, " -- nothing") == "SQL: there is no statement");
  CHECK(refusal_of(store, "SELECT json('{')") == "SQL: malformed JSON");
}

TEST_CASE("a second statement is refused, not ignored") {
  const Store store = Store::in_memory();
  CHECK(refusal_of(store, "SELECT 1; DROP TABLE jobs") ==
        "SQL: one statement at a time; not expected:  DROP TABLE jobs");
}

TEST_CASE("a query that would write is refused") {
  const TemporaryFolder folder;
  Store::create(folder / "a.db").add(plan({cooling()}));
  const Reader reader(folder / "a.db");
  const Store store = Store::open(folder / "a.db");
  for (const Reader* one : {&reader, static_cast<const Reader*>(&store)})
    for (const std::string sql :
         {"DELETE FROM jobs", "DROP VIEW mean_series", "CREATE TABLE t (x)",
          "INSERT INTO results VALUES (1, 2, 3)", "PRAGMA journal_mode = DELETE"})
      CHECK(refusal_of(*one, sql) == "SQL: this statement would write; a query only reads: " + sql);
  const std::string copy = "VACUUM INTO '" + (folder / "copy.db").string() + "'";
  CHECK(refusal_of(reader, copy).starts_with("SQL: this statement would write"));
  CHECK_FALSE(std::filesystem::exists(folder / "copy.db"));
  CHECK(refusal_of(reader, "ATTACH '" + (folder / "new.db").string() + "' AS new") ==
        "SQL: not authorized");
  CHECK_FALSE(std::filesystem::exists(folder / "new.db"));
  CHECK(reader.jobs().size() == 2);
}

TEST_CASE("a query runs while a writer holds the store") {
  const TemporaryFolder folder;
  Store store = Store::create(folder / "a.db");
  store.open_log();
  store.add(plan({cooling()}));
  const Reader reader(folder / "a.db");
  Query query = reader.query("SELECT job_id FROM jobs");
  CHECK(query.next());
  CHECK(store.claim(me, "test"));  // neither waits for the other
  CHECK(query.next());
  CHECK_FALSE(query.next());
}
