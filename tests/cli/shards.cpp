// Campaigns divided among shards: run apart, killed, merged in any order, the same rows come home.
#include <doctest/doctest.h>

#include <algorithm>
#include <csignal>
#include <random>

#include "cli/program.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

// Three scenes, with everything that a store can hold of a job.
constexpr const char* grid = R"({
  "n": 0.3, "N": 500, "seeds": 3, "tau_max": 60, "equilibrate": 20, "checkpoint_every": 10,
  "grids": [
    {"e": [0.8, 0.95], "profiles_every": 20, "fields_at": [20], "observables":
      ["temperature", "laguerre", "distribution", "correlations", "clusters", "fields"]},
    {"e": 0.7, "effects": {"roughness": {"beta": 0.5, "q": 0.4}}}]})";

void plan(const Folder& folder, const char* text) {
  folder.write("grid.json", text);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
}

std::string calm_rows() {
  const Folder folder;
  plan(folder, grid);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
  return rows(folder);
}

// The shards in a folder, in random order.
std::vector<std::string> shuffled_shards(const Folder& folder, const std::string& in,
                                         std::mt19937& random) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder / in))
    if (entry.path().extension() == ".db") paths.push_back(entry.path().string());
  std::ranges::sort(paths);
  std::ranges::shuffle(paths, random);
  return paths;
}

// Starts the command and kills it after some milliseconds, if it still runs then.
void kill_after(const Folder& folder, std::vector<std::string> words,
                std::chrono::milliseconds time) {
  Program program(folder, std::move(words));
  sleep_for(time);
  const auto workers = program.workers();
  program.signal(SIGKILL);
  program.wait();
  for (const pid_t worker : workers)
    for (int patience = 0; is_alive(worker) && patience < 400; ++patience) sleep_for(5ms);
}

// Divides, runs, kills, merges and recalls at random until nothing is pending or lent.
void wander(const Folder& folder, std::mt19937& random) {
  const auto some = [&](unsigned most) { return std::chrono::milliseconds(random() % most); };
  for (int round = 0;; ++round) {
    REQUIRE_MESSAGE(round < 60, "the campaign does not come to an end");
    const std::string out = "round-" + std::to_string(round);
    REQUIRE(campaign(folder, {"split", "--into", std::to_string(1 + random() % 4), "--out", out})
                .exit_code == 0);
    if (!std::filesystem::exists(folder / out)) break;
    for (const std::string& shard : shuffled_shards(folder, out, random)) {
      if (random() % 4 == 0) continue;  // this one is lost before it has begun
      if (random() % 2 == 0)
        kill_after(folder, {"run", "--store", shard}, some(60));
      else
        CHECK(campaign(folder, {"run", "--store", shard}).exit_code == 0);
    }
    for (int again = 0; again < 2; ++again)
      for (const std::string& shard : shuffled_shards(folder, out, random)) {
        if (random() % 2 == 0) kill_after(folder, {"merge", shard}, some(12));
        if (random() % 4 > 0) CHECK(campaign(folder, {"merge", shard}).exit_code == 0);
      }
    for (const std::string& shard : shuffled_shards(folder, out, random)) {
      if (random() % 3 == 0) std::filesystem::remove(shard);
      CHECK(campaign(folder, {"recall", shard}).exit_code == 0);
    }
    if (random() % 3 == 0) kill_after(folder, {"run"}, some(60));
  }
}

std::string first_shard(const Folder& folder) {
  return (folder / "shards" / "shard-001.db").string();
}

}  // namespace

TEST_CASE("shards: divided, killed and merged at random, the rows are those of one run") {
  const std::string expected = calm_rows();
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const Folder folder;
    plan(folder, grid);
    wander(folder, random);
    CHECK(rows(folder) == expected);
    CHECK(campaign(folder, {"run"}).exit_code == 0);
    CHECK(campaign(folder, {"verify"}).exit_code == 0);
  }
}

TEST_CASE("shards: what is lent is not run at home, and merging while a run is on is allowed") {
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
    "shards: what is no shard of this campaign is refused by name, and costs the others nothing") {
  const Folder folder;
  plan(folder, grid);
  REQUIRE(campaign(folder, {"split", "--into", "2"}).exit_code == 0);
  for (const char* shard : {"shards/shard-001.db", "shards/shard-002.db"})
    REQUIRE(campaign(folder, {"run", "--store", shard}).exit_code == 0);

  const Folder other;
  plan(other, grid);
  REQUIRE(campaign(other, {"split", "--into", "1"}).exit_code == 0);
  folder.write("nonsense.db", "this is no store");

  const std::string foreign = first_shard(other);
  const Outcome merged =
      campaign(folder, {"merge", foreign, "nonsense.db", "campaign.db", "nowhere.db",
                        "shards/shard-001.db", "shards/shard-002.db"});
  CHECK(merged.exit_code == 1);
  for (const std::string& word :
       {foreign + ": is a shard of another campaign", std::string("nonsense.db: "),
        std::string("campaign.db: is a store, but not a shard"),
        std::string("nowhere.db: there is no such store")})
    CHECK_MESSAGE(merged.err.find(word) != std::string::npos, merged.err);
  CHECK(rows(folder) == calm_rows());
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
  CHECK(rows(folder) == calm_rows());
}
