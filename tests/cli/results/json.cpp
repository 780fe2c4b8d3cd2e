// SPDX-License-Identifier: GPL-3.0-or-later

// --json: output and errors that other programs can read.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "cli/program.hpp"

using namespace haff::tests;
using nlohmann::json;

namespace {

void plan(const Folder& folder) {
  folder.write("grid.json", R"({"e": [0.8, 0.9], "n": 0.4, "N": 500, "seeds": 2, "tau_max": 20})");
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
}

json parsed(const Outcome& outcome) {
  CAPTURE(outcome.out);
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  return json::parse(outcome.out);
}

}  // namespace

TEST_CASE("json: plan reports what it added, and a second plan that nothing is new") {
  const Folder folder;
  folder.write("grid.json", R"({"e": [0.8, 0.9], "n": 0.4, "N": 500, "seeds": 2, "tau_max": 20})");
  const json would = parsed(campaign(folder, {"plan", "grid.json", "--dry-run", "--json"}));
  CHECK(would["dry_run"] == true);
  CHECK(would["added"] == 6);
  CHECK(would["next"] == "campaign plan grid.json");
  const json first = parsed(campaign(folder, {"plan", "grid.json", "--json"}));
  CHECK(first["jobs"] == 6);
  CHECK(first["added"] == 6);
  CHECK(first["groups"].size() == 3);
  CHECK(first["groups"][0]["kind"] == "equilibration");
  CHECK(first["expected_cpu_seconds"] > 0);
  // Small gases: no more threads than workers.
  CHECK(first["expected_seconds"] > 0);
  CHECK(first["expected_seconds"].get<double>() <=
        first["expected_cpu_seconds"].get<double>() * (1 + 1e-9));
  CHECK(first["most_threads_of_worker"] == 1);
  CHECK(first["boxes"].size() == 2);
  CHECK(first["warnings"].size() == 2);
  const json second = parsed(campaign(folder, {"--json", "plan", "grid.json"}));
  CHECK(second["added"] == 0);
  CHECK(second["unchanged"] == 6);
}

TEST_CASE("json: run, verify, retry, explain, split, merge and recall") {
  const Folder folder;
  plan(folder);
  const json split = parsed(campaign(folder, {"split", "--into", "2", "--json"}));
  REQUIRE(split["shards"].size() == 2);
  CHECK(split["shards"][0]["shard"] == "shard-001");
  const json explained = parsed(campaign(folder, {"explain", "1", "--json"}));
  CHECK(explained["status"] == "lent");
  const json merged = parsed(campaign(folder, {"merge", "shards/shard-001.db", "--json"}));
  CHECK(merged["shards"][0]["new_rows"] == 0);
  CHECK(merged["still_lent"] > 0);
  const json back = parsed(campaign(folder, {"recall", "shard-001", "shard-002", "--json"}));
  CHECK(back["shards"].size() == 2);
  const json ran = parsed(campaign(folder, {"run", "--json"}));
  CHECK(ran["exit_code"] == 0);
  CHECK(ran["jobs"]["done"] == 6);
  CHECK(parsed(campaign(folder, {"verify", "--json"}))["sound"] == true);
  const json costs = parsed(campaign(folder, {"cost", "--json"}));
  CHECK(costs["rows"][0]["row"] == "mean");
  CHECK(costs["written"][0] == "cost/cost.csv");
  CHECK(parsed(campaign(folder, {"retry", "--json"}))["reopened"] == 0);
  CHECK(parsed(campaign(folder, {"query", "SELECT 1 AS one", "--json"}))[0]["one"] == 1);
  CHECK(parsed(campaign(folder, {"theory", "--list", "--json"})).size() > 5);
}

TEST_CASE("json: plot --list, and no picture") {
  const Folder folder;
  plan(folder);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
  const json list = parsed(campaign(folder, {"plot", "--list", "--json"}));
  CHECK(list["columns"][0]["name"] == "time");
  CHECK(list["quantities"].size() == 5);
  for (const json& each : list["parameters"])
    if (each["name"] == "e") CHECK(each["values"] == json({0.8, 0.9}));
  const Outcome picture = campaign(folder, {"plot", "a2", "--json"});
  CHECK(picture.exit_code == 2);
  CHECK(json::parse(picture.err)["error"].get<std::string>().find("plot --list") !=
        std::string::npos);
}

TEST_CASE("json: verify of a fault, with its exit code") {
  const Folder folder;
  plan(folder);
  edit_rows(folder, "UPDATE jobs SET identity = 'nothing' WHERE job_id = 1");
  const Outcome outcome = campaign(folder, {"verify", "--json"});
  CHECK(outcome.exit_code == 1);
  const json found = json::parse(outcome.out);
  CHECK(found["sound"] == false);
  CHECK(found["faults"] > 0);
}

TEST_CASE("json: errors are one line of JSON on stderr, and nothing is on stdout") {
  const Folder folder;
  const auto error_of = [&](const std::vector<std::string>& words) {
    const Outcome outcome = campaign(folder, words);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.find('\n') == outcome.err.size() - 1);
    const json error = json::parse(outcome.err);
    CHECK(error["exit_code"] == outcome.exit_code);
    CHECK_FALSE(error["error"].get<std::string>().empty());
    return outcome.exit_code;
  };
  CHECK(error_of({"status", "--json"}) == 2);           // no store
  CHECK(error_of({"status", "--json", "--bad"}) == 2);  // no such option
  folder.write("grid.json", "{");
  CHECK(error_of({"plan", "grid.json", "--json"}) == 2);
  plan(folder);
  CHECK(error_of({"query", "SELECT", "--json"}) == 2);
  CHECK(error_of({"explain", "99", "--json"}) == 2);
  CHECK(error_of({"figures", "--json"}) == 2);  // writes files, prints no JSON
  edit_rows(folder, "DROP TABLE jobs");
  CHECK(error_of({"status", "--json"}) != 0);
}
