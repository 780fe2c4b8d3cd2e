// Tasks and nodes of a real Slurm (support/slurm_cluster.hpp) disturbed in every way that happens
// on a cluster: minutes, since Slurm itself waits for nodes and counts time limits in minutes.
#include <doctest/doctest.h>

#include <csignal>

#include "cli/program.hpp"
#include "support/slurm_cluster.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

void plan(const Folder& folder, const std::string& text) {
  folder.write("grid.json", text);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
}

std::string calm_rows(const std::string& text) {
  const Folder folder;
  plan(folder, text);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
  return rows(folder);
}

void submit(const Folder& folder, const std::string& time) {
  const Outcome outcome = campaign(folder, {"submit", "--tasks", "3", "--cpus", "1", "--time", time,
                                            "--put-back-every", "1s", "--", "--mem=100"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
}

std::string logs(const Folder& folder) {
  return shell(folder, "tail -n 30 shards/*.log").out;
}

void wait_for_tasks(const Folder& folder, const std::string& state, int count) {
  for (int patience = 0; patience < 600; ++patience) {
    const Outcome seen =
        shell(folder, "squeue --noheader --me --array --states=" + state + " | wc -l");
    if (std::stoi(seen.out) >= count) return;
    sleep_for(100ms);
  }
  FAIL("no " << count << " tasks are " << state << ":\n" << logs(folder));
}

// Some ten seconds of work in few jobs, for what is to be disturbed.
constexpr const char* long_grid = R"({
  "e": [0.9, 0.95], "n": 0.4, "N": 1000, "seeds": 3, "tau_max": 3000, "sample_every": 10,
  "checkpoint_every": 10})";

void check_home(const Folder& folder, const std::string& expected) {
  CAPTURE(logs(folder));
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status <> 'done'") == 0);
  CHECK(rows(folder) == expected);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
}

}  // namespace

TEST_CASE("slurm: tasks cancelled, requeued and killed, a node down: the same rows come home") {
  const std::string expected = calm_rows(long_grid);
  const Folder folder;
  const SlurmCluster cluster(folder / "slurm");
  plan(folder, long_grid);
  submit(folder, "5m");
  wait_for_tasks(folder, "RUNNING", 3);
  sleep_for(1500ms);

  // One task is cancelled, one requeued, one loses its workers.
  const std::string job = shell(folder,
                                "sed -n 's/.*tasks_job\": \"\\(.*\\)\".*/\\1/p' "
                                "shards/round-001.json | tr -d '\\n'")
                              .out;
  REQUIRE_FALSE(job.empty());
  cluster.slurm("scancel " + job + "_1");
  cluster.slurm("scontrol requeue " + job + "_2");
  // The workers of the third, known by the store that they work on.
  shell(folder,
        "for p in /proc/[0-9]*; do tr '\\0' ' ' < $p/cmdline 2> /dev/null | "
        "grep -q 'campaign-.*/shard.db worker' && readlink $p/exe | grep -q campaign && "
        "[ \"$(tr '\\0' '\\n' < $p/environ | sed -n 's/^SLURM_CONF=//p')\" = \"$SLURM_CONF\" ] "
        "&& kill -9 ${p#/proc/}; done; true");
  // A node whose daemon is killed is set down, and comes back.
  kill(cluster.daemon("n2"), SIGKILL);
  cluster.slurm("scontrol update nodename=n2 state=down reason=test");
  sleep_for(1500ms);
  cluster.start_daemon("n2");
  cluster.slurm("scontrol update nodename=n2 state=resume || true");

  cluster.wait_until_empty(240);
  // A user who cancelled tasks may have to submit once more.
  if (number(folder, "SELECT count(*) FROM jobs WHERE status <> 'done'") > 0) {
    campaign(folder, {"merge", "shards/shard-001.db"});
    shell(folder, "for s in shards/shard-*.db; do \"$campaign\" recall $s; done");
    submit(folder, "5m");
    cluster.wait_until_empty(240);
  }
  check_home(folder, expected);
}

TEST_CASE("slurm: a time limit strikes, and what is left is done in further rounds") {
  // Some three minutes of work for one task with a limit of one minute, of which a quarter is
  // reserved for storing.
  const char* slow_grid = R"({"e": 0.95, "n": 0.4, "N": 4000, "seeds": 2, "tau_max": 40000,
    "sample_every": 100, "checkpoint_every": 100, "observables": ["temperature"]})";
  const Folder folder;
  const SlurmCluster cluster(folder / "slurm");
  plan(folder, slow_grid);
  submit(folder, "1m");
  cluster.wait_until_empty(550);
  CHECK(std::filesystem::exists(folder / "shards/round-002.json"));
  check_home(folder, calm_rows(slow_grid));
}
