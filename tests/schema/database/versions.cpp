// SPDX-License-Identifier: GPL-3.0-or-later

// The schema of a store must be exactly that of the program; otherwise the store is refused.
#include "schema/database/versions.hpp"

#include <doctest/doctest.h>

#include <string>

#include "schema/database/database.hpp"
#include "schema/fixture.hpp"

using namespace haff::schema;

namespace {

// The complaint about a store in which another program has run this SQL, up to its first semicolon.
std::string message_after(const std::string& sql) {
  const TemporaryFolder folder;
  const auto path = folder / "a.db";
  Store::create(path).add(plan({cooling()}));
  SQLite::Database(path.string(), SQLite::OPEN_READWRITE).exec(sql);
  std::string said = "nothing";
  try {
    const Reader reader(path);
  } catch (const Damage& damage) {
    said = std::string(damage.what()).substr(path.string().size() + 2);
    CHECK_THROWS_AS(Store::open(path), Damage);
    CHECK_THROWS_AS(Store::create(path), Damage);
  }
  return said.substr(0, said.find(';'));
}

}  // namespace

TEST_CASE("a schema that is not the program's is refused, by name") {
  CHECK(message_after("DROP VIEW mean_series") == "its view mean_series is gone");
  CHECK(message_after("DROP TABLE results") == "its table results is gone");
  CHECK(message_after("ALTER TABLE jobs ADD COLUMN x TEXT") ==
        "its table jobs is not as this program makes it");
  CHECK(message_after("CREATE TRIGGER t AFTER INSERT ON samples BEGIN DELETE FROM jobs; END") ==
        "the trigger t in it is not of this program's making");
  CHECK(message_after("CREATE INDEX i ON samples (abs(tau))") ==
        "the index i in it is not of this program's making");
  CHECK(message_after("CREATE VIRTUAL TABLE v USING fts5 (x)") ==
        "the virtual table v in it is not of this program's making");
}

TEST_CASE("an endless view in place of a table is refused at once") {
  CHECK(message_after(
            "PRAGMA writable_schema = ON; UPDATE sqlite_schema SET type = 'view', rootpage = "
            "0, sql = 'CREATE VIEW jobs AS WITH RECURSIVE n(x) AS (SELECT 1 UNION ALL SELECT "
            "x + 1 FROM n) SELECT x AS job_id FROM n' WHERE name = 'jobs'; DELETE FROM "
            "sqlite_schema WHERE type = 'index' AND tbl_name = 'jobs'")
            .find("jobs") != std::string::npos);
}

TEST_CASE("tables and views that a user has added are left alone") {
  CHECK(
      message_after("CREATE TABLE notes (job_id PRIMARY KEY, text); CREATE VIEW hot AS SELECT tau "
                    "FROM samples WHERE temperature > 0.5") == "nothing");
}
