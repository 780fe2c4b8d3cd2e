// SPDX-License-Identifier: GPL-3.0-or-later

#include <doctest/doctest.h>

#include "cli/program.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

void plan(const Folder& folder, const std::string& grid) {
  folder.write("grid.json", grid);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
}

constexpr const char* small = R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 1, "tau_max": 5})";

std::string answer(const std::string& sql, const std::string& format) {
  const Folder folder;
  plan(folder, small);
  return campaign(folder, {"query", sql, "--format", format}).out;
}

}  // namespace

TEST_CASE("query: csv has a head, all digits, and nothing for NULL") {
  CHECK(answer("SELECT 0.1 AS x, 1 AS k, NULL AS none, 'a,\"b\"' AS t, 2.0 AS two", "csv") ==
        "x,k,none,t,two\n0.10000000000000001,1,,\"a,\"\"b\"\"\",2.0\n");
}

TEST_CASE("query: json has all digits and null for NULL") {
  CHECK(answer("SELECT 0.1 AS x, NULL AS none UNION ALL SELECT 1.0, 'b\"'", "json") ==
        "[\n  {\"x\": 0.10000000000000001, \"none\": null},\n"
        "  {\"x\": 1.0, \"none\": \"b\\\"\"}\n]\n");
}

TEST_CASE("query: json of no rows is an empty list") {
  CHECK(answer("SELECT 1 WHERE 0", "json") == "[]\n");
}

TEST_CASE("query: a table is aligned") {
  CHECK(answer("SELECT 1.5 AS x, 'ab' AS name UNION ALL SELECT 10, NULL", "table") ==
        "  x  name\n---  ----\n1.5  ab\n 10  NULL\n");
}

TEST_CASE("query: a query cannot write") {
  const Folder folder;
  plan(folder, small);
  for (const char* sql : {"DELETE FROM jobs", "CREATE TABLE x (y)", "PRAGMA user_version = 9",
                          "ATTACH 'other.db' AS other"}) {
    CAPTURE(sql);
    CHECK(campaign(folder, {"query", sql}).exit_code == 2);
  }
  CHECK(number(folder, "SELECT count(*) FROM jobs") == 2);
  CHECK_FALSE(std::filesystem::exists(folder / "other.db"));
}

TEST_CASE("query: wrong SQL is bad input") {
  const Folder folder;
  plan(folder, small);
  const Outcome outcome = campaign(folder, {"query", "SELECT nothing FROM jobs"});
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.err.find("nothing") != std::string::npos);
}

TEST_CASE("query: query, status and sqlite3 work during a run") {
  const Folder folder;
  plan(folder, R"({"e": 0.9, "n": 0.4, "N": 1000, "seeds": 4, "tau_max": 1500})");
  Program run(folder, {"run", "--workers", "2"});
  int asked = 0;
  for (; run.runs() && asked < 4; ++asked) {
    CHECK(campaign(folder, {"query", "SELECT count(*) FROM samples"}).exit_code == 0);
    CHECK(campaign(folder, {"status"}).exit_code == 0);
    CHECK(campaign(folder, {"status", "--json"}).exit_code == 0);
    CHECK(shell(folder, "sqlite3 campaign.db 'SELECT count(*) FROM mean_series'").exit_code == 0);
    CHECK(campaign(folder, {"verify"}).exit_code == 0);
  }
  CHECK_MESSAGE(asked >= 2, "the run is too short to be asked anything");
  CHECK(run.wait().exit_code == 0);
}
