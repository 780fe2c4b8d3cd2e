// SPDX-License-Identifier: GPL-3.0-or-later

// Campaigns divided among shards: run apart, killed and merged in any order, they have the same
// rows.
#include <doctest/doctest.h>

#include <random>

#include "support/divided_campaign.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

// Three scenes, with all data that a store can hold of a job.
const std::string grid = R"({
  "n": 0.3, "N": 500, "seeds": 3, "tau_max": 60, "equilibrate": 20, "checkpoint_every": 10,
  "grids": [
    {"e": [0.8, 0.95], "profiles_every": 20, "fields_at": [20], "observables":
      ["temperature", "laguerre", "distribution", "correlations", "clusters", "fields"]},
    {"e": 0.7, "effects": {"roughness": {"beta": 0.5, "q": 0.4}}}]})";

std::string first_shard(const Folder& folder) {
  return (folder / "shards" / "shard-001.db").string();
}

}  // namespace

TEST_CASE(
    "shards: random campaigns, divided, killed and merged at random, are the same in every bit") {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) run_random_campaign(seed);
}

TEST_CASE("shards: a merge killed at 100 moments leaves a store that the next one completes") {
  const std::string expected = undisturbed_rows(grid);
  std::mt19937 random(11);
  const Folder folder;
  plan(folder, grid);
  REQUIRE(campaign(folder, {"split", "--into", "3"}).exit_code == 0);
  const std::vector<std::string> shards{"shards/shard-001.db", "shards/shard-002.db",
                                        "shards/shard-003.db"};
  for (const std::string& shard : shards)
    REQUIRE(campaign(folder, {"run", "--store", shard}).exit_code == 0);
  std::filesystem::copy_file(folder.store(), folder / "lent.db");
  std::vector<std::string> merge{"merge"};
  merge.insert(merge.end(), shards.begin(), shards.end());

  int killed = 0;
  for (int tries = 0; killed < 100; ++tries) {
    REQUIRE(tries < 2000);
    killed += kill_after(folder, merge, std::chrono::milliseconds(random() % 60)) ? 1 : 0;
    if (tries % 8 < 7) continue;
    REQUIRE(campaign(folder, merge).exit_code == 0);
    CHECK(rows(folder) == expected);
    for (const char* log : {"-journal", "-wal", "-shm"})
      std::filesystem::remove(folder.store().string() + log);
    std::filesystem::copy_file(folder / "lent.db", folder.store(),
                               std::filesystem::copy_options::overwrite_existing);
  }
  REQUIRE(campaign(folder, merge).exit_code == 0);
  check_completed(folder, expected);
}

TEST_CASE("shards: lent jobs are not run in the store, and a merge during a run is allowed") {
  const Folder folder;
  plan(folder, grid);
  REQUIRE(campaign(folder, {"split", "--into", "2"}).exit_code == 0);
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK(number(folder, "SELECT count(*) FROM samples") == 0);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'lent'") == 12);

  REQUIRE(campaign(folder, {"run", "--store", first_shard(folder)}).exit_code == 0);
  folder.write("more.json", R"({"e": 0.9, "n": 0.2, "N": 1000, "seeds": 2, "tau_max": 200})");
  REQUIRE(campaign(folder, {"plan", "more.json"}).exit_code == 0);
  Program run(folder, {"run"});
  CHECK(campaign(folder, {"merge", first_shard(folder)}).exit_code == 0);
  CHECK(run.wait().exit_code == 0);
  const double still_lent = number(folder, "SELECT count(*) FROM jobs WHERE status = 'lent'");
  CHECK(still_lent > 0);
  CHECK(still_lent < 12);
  CHECK(number(folder, "SELECT count(*) FROM shards WHERE returned IS NOT NULL") == 1);
}

TEST_CASE("shards: a row that differs in its last bit is named, and nothing is overwritten") {
  const Folder folder;
  plan(folder, grid);
  REQUIRE(campaign(folder, {"split", "--into", "1"}).exit_code == 0);
  REQUIRE(campaign(folder, {"run", "--store", first_shard(folder)}).exit_code == 0);
  REQUIRE(campaign(folder, {"merge", first_shard(folder)}).exit_code == 0);
  const std::string before = rows(folder);
  const double temperature =
      number(folder, "SELECT temperature FROM samples WHERE tau = 40 ORDER BY job_id DESC LIMIT 1");
  const Outcome changed = shell(folder,
                                "sqlite3 shards/shard-001.db \"UPDATE samples SET temperature "
                                "= temperature * (1 + 2.3e-16) WHERE tau = 40; "
                                "UPDATE digests SET samples = NULL\"");
  REQUIRE(changed.exit_code == 0);
  const Outcome merged = campaign(folder, {"merge", first_shard(folder)});
  CHECK(merged.exit_code == 1);
  for (const char* word : {"samples of job", "tau = 40", "temperature", "here", "there"})
    CHECK_MESSAGE(merged.err.find(word) != std::string::npos, merged.err);
  CHECK(rows(folder) == before);
  CHECK(temperature > 0);
}

TEST_CASE(
    "shards: a file that is not a shard of this campaign is refused by name, and others are "
    "merged") {
  const Folder folder;
  plan(folder, grid);
  REQUIRE(campaign(folder, {"split", "--into", "2"}).exit_code == 0);
  for (const char* shard : {"shards/shard-001.db", "shards/shard-002.db"})
    REQUIRE(campaign(folder, {"run", "--store", shard}).exit_code == 0);

  const Folder other;
  plan(other, grid);
  REQUIRE(campaign(other, {"split", "--into", "1"}).exit_code == 0);
  folder.write("nonsense.db", "this is no store");
  REQUIRE(
      shell(folder, "cp shards/shard-001.db newer.db; sqlite3 newer.db 'PRAGMA user_version = 999'")
          .exit_code == 0);

  const std::string foreign = first_shard(other);
  const Outcome merged =
      campaign(folder, {"merge", foreign, "nonsense.db", "campaign.db", "nowhere.db", "newer.db",
                        "shards/shard-001.db", "shards/shard-002.db"});
  CHECK(merged.exit_code == 1);
  for (const std::string& word :
       {foreign + ": is a shard of another campaign", std::string("nonsense.db: "),
        std::string("newer.db: was written by a newer program"),
        std::string("campaign.db: is a store, but not a shard"),
        std::string("nowhere.db: there is no such store")})
    CHECK_MESSAGE(merged.err.find(word) != std::string::npos, merged.err);
  CHECK(rows(folder) == undisturbed_rows(grid));
}

TEST_CASE("shards: a damaged state is refused, and recall computes it again") {
  const Folder folder;
  plan(folder, grid);
  REQUIRE(campaign(folder, {"split", "--into", "1"}).exit_code == 0);
  REQUIRE(campaign(folder, {"run", "--store", first_shard(folder)}).exit_code == 0);
  REQUIRE(shell(folder,
                "sqlite3 shards/shard-001.db \"UPDATE checkpoint_chunks SET bytes = "
                "zeroblob(length(bytes))\"")
              .exit_code == 0);
  CHECK(campaign(folder, {"merge", first_shard(folder)}).exit_code == 1);
  CHECK(campaign(folder, {"recall", "shard-001"}).exit_code == 0);
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK(rows(folder) == undisturbed_rows(grid));
}
