// A campaign on a real Slurm of two nodes (support/slurm_cluster.hpp): whatever happens to tasks
// and nodes, the store that comes home has the rows of one undisturbed run.
#include <doctest/doctest.h>

#include <csignal>

#include "cli/program.hpp"
#include "support/slurm_cluster.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

// Everything that a store can hold of a job: an effect, profiles, fields, and a target whose seeds
// are found in later rounds.
constexpr const char* grid = R"({
  "n": 0.3, "N": 500, "seeds": 3, "equilibrate": 20, "checkpoint_every": 10,
  "grids": [
    {"e": [0.8, 0.95], "tau_max": 60, "profiles_every": 20, "fields_at": [20], "observables":
      ["temperature", "laguerre", "distribution", "correlations", "clusters", "fields"]},
    {"e": 0.7, "tau_max": 60, "effects": {"roughness": {"beta": 0.5, "q": 0.4}}},
    {"e": 0.9, "seeds": 5, "tau_max": 15, "target": {"a2": {"tau": [5, 15], "se": 0.01}}}]})";

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

TEST_CASE("slurm: a campaign with effects and a target comes home over two nodes") {
  const std::string expected = calm_rows(grid);
  const Folder folder;
  const SlurmCluster cluster(folder / "slurm");
  plan(folder, grid);
  const Outcome dry = campaign(folder, {"submit", "--tasks", "3", "--time", "5m", "--dry-run"});
  CHECK(dry.exit_code == 0);
  CHECK(dry.out.find("sbatch --parsable") != std::string::npos);
  CHECK(dry.out.find("--array=1-3") != std::string::npos);
  CHECK(dry.out.find("campaign") != std::string::npos);
  CHECK(number(folder, "SELECT count(*) FROM shards") == 0);

  submit(folder, "5m");
  const Outcome again = campaign(folder, {"submit", "--tasks", "3", "--time", "5m"});
  CHECK(again.exit_code == 1);
  CHECK(again.err.find("submitted before") != std::string::npos);
  CHECK(campaign(folder, {"status"}).out.find("shard-001") != std::string::npos);

  cluster.wait_until_empty(180);
  check_home(folder, expected);
  // Nothing was computed twice: the shards' CPU time is that of the jobs, and each shard came home.
  CHECK(number(folder, "SELECT count(*) FROM shards WHERE returned IS NULL") == 0);
  CHECK(number(folder,
               "SELECT count(*) FROM (SELECT job_id FROM loans JOIN jobs USING (job_id) "
               "WHERE kind = 'cooling' GROUP BY job_id HAVING count(*) > 1)") == 0);
}

TEST_CASE("slurm: where there is no sbatch, the other ways are told") {
  const Folder folder;
  plan(folder, grid);
  const Outcome outcome =
      shell(folder, "PATH=/nowhere \"$campaign\" submit --tasks 4 --cpus 2 --time 1h");
  CHECK(outcome.exit_code == 1);
  for (const char* word :
       {"no sbatch", "campaign split --into 4", "parallel", "qsub", "HTCondor", "campaign merge"})
    CHECK_MESSAGE(outcome.err.find(word) != std::string::npos, outcome.err);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'lent'") == 0);
}

TEST_CASE("slurm: a task by hand puts its shard back while it works, stops in order and goes on") {
  const std::string expected = calm_rows(long_grid);
  const Folder folder;
  plan(folder, long_grid);
  REQUIRE(campaign(folder, {"split", "--into", "1"}).exit_code == 0);
  const std::vector<std::string> words{"task", "shards/shard-001.db", "--put-back-every",
                                       "0.5s", "--workers",           "2"};
  {
    Program task(folder, words);
    sleep_for(2500ms);
    // A node that dies: everything on it is gone, without a word.
    for (const pid_t child : task.workers()) kill(child, SIGKILL);
    task.signal(SIGKILL);
    task.wait();
  }
  CHECK(campaign(folder, {"merge", "shards/shard-001.db"}).exit_code == 0);
  CHECK(number(folder, "SELECT count(*) FROM checkpoints") > 0);
  {
    Program task(folder, words);
    sleep_for(800ms);
    task.signal(SIGUSR1);
    task.wait();
  }
  CHECK(campaign(folder, words).exit_code == 0);
  CHECK(campaign(folder, {"merge", "shards/shard-001.db"}).exit_code == 0);
  CHECK(rows(folder) == expected);
  CHECK_FALSE(std::filesystem::exists(folder / "shards/shard-001.db.task"));
}

TEST_CASE("slurm: a scratch folder that fills up costs what was not put back") {
  const Folder folder;
  plan(folder, long_grid);
  REQUIRE(campaign(folder, {"split", "--into", "1"}).exit_code == 0);
  // The limit is on the size of a file, which a full disk is to the one that writes it.
  const Outcome full = shell(folder,
                             "ulimit -f 400; exec \"$campaign\" task shards/shard-001.db "
                             "--put-back-every 0.5s --workers 2");
  CAPTURE(full.err);
  CHECK(full.exit_code != 0);
  CHECK(campaign(folder, {"verify", "--store", "shards/shard-001.db"}).exit_code == 0);
  CHECK(campaign(folder, {"task", "shards/shard-001.db", "--workers", "2"}).exit_code == 0);
  CHECK(campaign(folder, {"merge", "shards/shard-001.db"}).exit_code == 0);
  CHECK(rows(folder) == calm_rows(long_grid));
}
