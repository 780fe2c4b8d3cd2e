// SPDX-License-Identifier: GPL-3.0-or-later

// Tasks and nodes of a real Slurm (support/slurm_cluster.hpp), disturbed in every way that happens
// on a cluster. This takes minutes, since Slurm itself waits for nodes and counts time limits in
// minutes. In the end the rows are those of one undisturbed run, in every bit, and only lost work
// was computed twice.
#include <doctest/doctest.h>

#include <csignal>
#include <fstream>
#include <sstream>

#include "support/divided_campaign.hpp"
#include "support/slurm_cluster.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

std::string paper_small() {
  std::ifstream file(HAFF_EXAMPLES "/paper-small.json");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void start(const Folder& folder, const std::string& time, std::vector<std::string> further = {}) {
  further.insert(further.begin(), {"--", "--mem=100"});
  const Outcome outcome = submit(folder, time, further);
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
}

// Submits again and again until no work is left, as a user does after a task was cancelled.
void go_on(const Folder& folder, const SlurmCluster& cluster, int seconds) {
  cluster.wait_until_empty(seconds);
  for (int round = 0; number(folder, "SELECT count(*) FROM jobs WHERE status <> 'done'") > 0;
       ++round) {
    REQUIRE_MESSAGE(round < 3, "the campaign does not come to an end:\n" << logs(folder));
    start(folder, "10m");
    cluster.wait_until_empty(seconds);
  }
}

// Sends a signal to the workers of all tasks, known by the shards that they work on.
void signal_workers(const Folder& folder, const std::string& signal) {
  const Outcome sent = shell(folder, R"SH(
    for p in /proc/[0-9]*; do
      case "$(readlink $p/exe)" in */campaign) ;; *) continue ;; esac
      tr '\0' ' ' < $p/cmdline 2> /dev/null | grep -q 'campaign-.*/shard.db worker' || continue
      tr '\0' '\n' < $p/environ 2> /dev/null | grep -qx "SLURM_CONF=$SLURM_CONF" || continue
      kill -)SH" + signal + R"SH( ${p#/proc/} && echo sent
    done)SH");
  CHECK(sent.out.find("sent") != std::string::npos);
}

}  // namespace

TEST_CASE("slurm: the paper's small grid, tasks cancelled, requeued and killed, a node lost") {
  const std::string grid = paper_small();
  const std::string expected = undisturbed_rows(grid);
  const Folder folder;
  const SlurmCluster cluster(folder / "slurm");
  plan(folder, grid);
  start(folder, "10m");
  wait_for_running(folder, "all", 3);
  for (const char* shard : {"shard-001", "shard-002", "shard-003"})
    wait_for_states(folder, shard, 1);
  const std::string job = tasks_job(folder, 1);

  cluster.slurm("scancel " + job + "_1");
  cluster.slurm("scontrol requeue " + job + "_2");
  signal_workers(folder, "KILL");
  sleep_for(3s);
  // A node whose daemon is killed goes on with its tasks, but Slurm does not see them.
  kill(cluster.daemon("n2"), SIGKILL);
  cluster.slurm("scontrol update nodename=n2 state=down reason=test");
  sleep_for(5s);
  cluster.start_daemon("n2");
  cluster.slurm("scontrol update nodename=n2 state=resume || true");
  go_on(folder, cluster, 800);
  check_completed(folder, expected);
  // A task that is cancelled stores what it can before it ends.
  CHECK(shell(folder, "cat shards/round-001-task-1.log").out.find("is left at tau = ") !=
        std::string::npos);
}

TEST_CASE("slurm: effects and a target, preempted and requeued: no stored work is done twice") {
  const std::string grid = R"({
    "n": 0.3, "N": 8000, "seeds": 3, "equilibrate": 20, "checkpoint_every": 10,
    "grids": [
      {"e": [0.8, 0.95], "tau_max": 1200, "sample_every": 5, "profiles_every": 100,
       "fields_at": [20], "observables":
        ["temperature", "laguerre", "distribution", "correlations", "clusters", "fields"]},
      {"e": 0.7, "tau_max": 800, "sample_every": 5,
       "effects": {"roughness": {"beta": 0.5, "q": 0.4}}},
      {"e": 0.9, "N": 1000, "seeds": 5, "tau_max": 15, "target": {"a2": {"tau": [5, 15], "se": 0.003}}}]})";
  const std::string expected = undisturbed_rows(grid);
  const Folder folder;
  const SlurmCluster cluster(folder / "slurm");
  plan(folder, grid);
  start(folder, "10m");
  wait_for_running(folder, "all", 3);
  wait_for_cooling(folder, "shard-001");

  // A partition of higher priority takes both nodes for a moment.
  cluster.slurm(
      "sbatch --partition=urgent --array=1-2 --cpus-per-task=2 --mem=100 --time=1 "
      "--output=/dev/null --wrap 'sleep 2'");
  wait_for_running(folder, "urgent", 2);
  wait_for_running(folder, "all", 3);
  sleep_for(1s);
  cluster.slurm("scontrol requeue " + tasks_job(folder, 1) + "_1");
  go_on(folder, cluster, 800);
  check_completed(folder, expected);
  CHECK(shell(folder, "cat shards/*.log").out.find("goes on from tau = ") != std::string::npos);
  CHECK(computed_twice(folder) == "");
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE e = 0.9 AND seed > 5") > 0);
}

TEST_CASE("slurm: a time limit ends tasks, and the next round does the remaining work") {
  // The tasks expect ten minutes but get one, without the signal before the end. Their workers hang
  // until Slurm ends them: SIGCONT, SIGTERM, and SIGKILL two seconds later.
  const std::string grid = R"({"e": [0.9, 0.95], "n": 0.4, "N": 1000, "seeds": 3, "tau_max": 5000,
    "sample_every": 50, "checkpoint_every": 50, "observables": ["temperature"]})";
  const std::string expected = undisturbed_rows(grid);
  const Folder folder;
  const SlurmCluster cluster(folder / "slurm");
  plan(folder, grid);
  start(folder, "10m", {"--time=1", "--signal=B:CONT@1"});
  for (const char* shard : {"shard-001", "shard-002", "shard-003"})
    wait_for_states(folder, shard, 1);
  signal_workers(folder, "STOP");
  go_on(folder, cluster, 300);
  CHECK(std::filesystem::exists(folder / "shards/round-002.json"));
  CHECK(shell(folder, "cat shards/*.log").out.find("DUE TO TIME LIMIT") != std::string::npos);
  CHECK(computed_twice(folder) == "");
  check_completed(folder, expected);
}

TEST_CASE(
    "slurm: a node's scratch folder is full, and jobs go on from the data that were put back") {
  const Folder folder;
  if (shell(folder, "mkdir small; mount -t tmpfs -o size=3m tmpfs small").exit_code != 0) {
    MESSAGE("SKIPPED: only root may mount a tmpfs where Slurm's tasks see it");
    return;
  }
  const std::string expected = undisturbed_rows(grid_with_everything);
  plan(folder, grid_with_everything);
  {
    const SlurmCluster cluster(folder / "slurm");
    const Outcome outcome = shell(folder,
                                  "TMPDIR=$PWD/small exec \"$campaign\" submit --tasks 1 --cpus 2 "
                                  "--time 10m --put-back-every 0.3s --rounds 1 -- --mem=100");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    cluster.wait_until_empty(200);
    CHECK_MESSAGE(logs(folder).find("disk is full") != std::string::npos, logs(folder));
    CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'pending'") > 0);
    shell(folder, "umount small");
    go_on(folder, cluster, 200);
  }
  check_completed(folder, expected);
  CHECK(computed_twice(folder) == "");
}
