// SPDX-License-Identifier: GPL-3.0-or-later

// A campaign on a real Slurm of two nodes (support/slurm_cluster.hpp), and tasks without one.
// tests/validate/slurm.cpp disturbs tasks and nodes in every way that Slurm can.
#include <doctest/doctest.h>

#include <csignal>

#include "support/divided_campaign.hpp"
#include "support/slurm_cluster.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

TEST_CASE("slurm: a campaign with effects and a target is completed on two nodes") {
  const std::string expected = undisturbed_rows(grid_with_everything);
  const Folder folder;
  const SlurmCluster cluster(folder / "slurm");
  plan(folder, grid_with_everything);
  const Outcome dry = campaign(folder, {"submit", "--tasks", "3", "--time", "5m", "--dry-run"});
  CHECK(dry.exit_code == 0);
  for (const char* word : {"sbatch --parsable", "--array=1-3", "--dependency=afterany:TASKS",
                           "campaign task --workers", "Nothing was written or submitted"})
    CHECK_MESSAGE(dry.out.find(word) != std::string::npos, dry.out);
  CHECK(number(folder, "SELECT count(*) FROM shards") == 0);

  REQUIRE(submit(folder, "5m", {"--", "--mem=100"}).exit_code == 0);
  const Outcome again = submit(folder, "5m");
  CHECK(again.exit_code == 1);
  CHECK_MESSAGE(again.err.find("round 1 is at work") != std::string::npos, again.err);
  CHECK(campaign(folder, {"status"}).out.find("shard-001") != std::string::npos);

  cluster.wait_until_empty(180);
  check_completed(folder, expected);
  CHECK(number(folder, "SELECT count(*) FROM shards WHERE returned IS NULL") == 0);
  CHECK(computed_twice(folder) == "");
  // The target was judged after the first round, and its further seeds were submitted.
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE e = 0.9") > 5);
  CHECK(std::filesystem::exists(folder / "shards/round-002.json"));
}

TEST_CASE(
    "slurm: a task without Slurm puts its shard back while it works, stops in order and goes on") {
  const Folder folder;
  plan(folder, long_grid);
  REQUIRE(campaign(folder, {"split", "--into", "1"}).exit_code == 0);
  const std::vector<std::string> words{"task", "shards/shard-001.db", "--put-back-every",
                                       "0.2s", "--workers",           "2"};
  {
    Program task(folder, words);
    wait_for_states(folder, "shard-001", 4);
    // The node dies without a message, and everything on it is lost.
    for (const pid_t child : task.workers()) kill(child, SIGKILL);
    task.signal(SIGKILL);
    task.wait();
  }
  CHECK(campaign(folder, {"merge", "shards/shard-001.db"}).exit_code == 0);
  CHECK(number(folder, "SELECT count(*) FROM checkpoints") >= 4);
  {
    Program task(folder, words);
    sleep_for(500ms);
    task.signal(SIGUSR1);
    CHECK(task.wait().exit_code == 128 + SIGTERM);
  }
  const Outcome last = campaign(folder, words);
  CHECK(last.exit_code == 0);
  CHECK_MESSAGE(last.err.find("goes on from tau = ") != std::string::npos, last.err);
  CHECK(campaign(folder, {"merge", "shards/shard-001.db"}).exit_code == 0);
  CHECK(rows(folder) == undisturbed_rows(long_grid));
  CHECK_FALSE(std::filesystem::exists(folder / "shards/shard-001.db.task"));
}

TEST_CASE("slurm: a task removes the scratch folders that killed tasks left, and no others") {
  const Folder folder;
  plan(folder, long_grid);
  REQUIRE(campaign(folder, {"split", "--into", "3"}).exit_code == 0);
  const std::string script = R"SH(
    mkdir scratch; export TMPDIR=$PWD/scratch
    left() { ls -d scratch/campaign-* | wc -l; }
    wait_for_folders() { for i in $(seq 500); do [ $(left) -ge $1 ] && return; sleep 0.02; done; }
    "$campaign" task shards/shard-001.db & killed=$!
    wait_for_folders 1; kill -9 $killed; wait $killed
    for i in $(seq 500); do flock -n scratch/campaign-*/in-use true && break; sleep 0.02; done
    mkdir scratch/campaign-of-the-user
    "$campaign" task shards/shard-002.db & at_work=$!
    "$campaign" task shards/shard-003.db; wait $at_work; ls scratch)SH";
  CHECK(shell(folder, script).out == "campaign-of-the-user\n");
  for (const char* shard : {"shards/shard-002.db", "shards/shard-003.db"})
    CHECK(campaign(folder, {"merge", shard}).exit_code == 0);
}

TEST_CASE("slurm: when a scratch folder is full, only data that were not put back are lost") {
  const Folder folder;
  plan(folder, grid_with_everything);
  REQUIRE(campaign(folder, {"split", "--into", "1"}).exit_code == 0);
  // The limit is on the size of a file; for the process that writes it this is the same as a full
  // disk.
  const Outcome full = shell(folder,
                             "ulimit -f 500; exec \"$campaign\" task shards/shard-001.db "
                             "--put-back-every 0.5s --workers 2");
  CAPTURE(full.err);
  CHECK(full.exit_code != 0);
  CHECK(campaign(folder, {"verify", "--store", "shards/shard-001.db"}).exit_code == 0);
  CHECK(campaign(folder, {"task", "shards/shard-001.db", "--workers", "2"}).exit_code == 0);
  CHECK(campaign(folder, {"merge", "shards/shard-001.db"}).exit_code == 0);
  CHECK(campaign(folder, {"run"}).exit_code == 0);  // the target's further seeds
  CHECK(rows(folder) == undisturbed_rows(grid_with_everything));
  // A scratch folder without room for the shard itself is named before any work is done.
  const Outcome none =
      shell(folder, "ulimit -f 10; exec \"$campaign\" task shards/shard-001.db --workers 2");
  CHECK(none.exit_code == 1);
  CHECK_MESSAGE(none.err.find("set TMPDIR to a folder with room") != std::string::npos, none.err);
}
