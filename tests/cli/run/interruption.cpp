// SPDX-License-Identifier: GPL-3.0-or-later

// The program killed and interrupted at any moment.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <random>

#include "cli/program.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

// Some three seconds of work for one core, long enough for two dozen kills. T/T_0 falls to 1e-20
// and below, so the engine's scaling of velocities is interrupted as well.
constexpr const char* long_grid = R"({
  "e": [0.9, 0.95], "n": 0.4, "N": 1000, "seeds": 3, "tau_max": 1500, "sample_every": 4,
  "checkpoint_every": 20, "profiles_every": 60, "fields_at": [300, 1500],
  "sample_at": {"tau": {"log": 5}, "time": {"log": 3}},
  "snapshots_at": {"tau": {"log": 2}, "time": {"log": 1}}, "observables":
  ["temperature", "laguerre", "distribution", "tail", "correlations", "structure",
   "pair_distribution", "energy_spectrum", "clusters", "cluster_sizes", "collision_statistics",
   "msd", "msd@100", "vacf@100", "fields"]})";

void plan(const Folder& folder, const char* grid) {
  folder.write("grid.json", grid);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
}

// The rows of an undisturbed campaign.
std::string undisturbed_rows(const char* grid) {
  const Folder folder;
  plan(folder, grid);
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
  return rows(folder);
}

void wait_until_dead(const std::vector<pid_t>& processes) {
  for (int patience = 0; patience < 200; ++patience) {
    if (std::none_of(processes.begin(), processes.end(), is_alive)) return;
    sleep_for(5ms);
  }
  FAIL("workers outlive their coordinator by a second");
}

class Storm {
 public:
  // Kills a worker, the coordinator, or all of them.
  void strike(Program& run) {
    const std::vector<pid_t> workers = run.workers();
    const auto choice = random() % 3;
    if (choice != 1)
      for (const pid_t worker : workers) {
        kill(worker, SIGKILL);
        if (choice == 0) break;
      }
    if (choice == 0) return;
    run.signal(SIGKILL);
    run.wait();
    wait_until_dead(workers);
  }

  std::chrono::milliseconds pause() { return std::chrono::milliseconds(10 + random() % 50); }

 private:
  std::mt19937 random{2003};
};

}  // namespace

TEST_CASE(
    "interruption: killed at random moments, a campaign ends with the rows of an undisturbed one") {
  const Folder folder;
  plan(folder, long_grid);
  Storm storm;
  int kills = 0;
  for (bool complete = false; !complete && kills < 24;) {
    Program run(folder, {"run", "--workers", "2"});
    while (kills < 24) {
      sleep_for(storm.pause());
      if (!run.runs()) {
        complete = run.wait().exit_code == 0;
        break;
      }
      storm.strike(run);
      ++kills;
      if (run.id() == 0) break;
    }
    CHECK(campaign(folder, {"verify"}).out.find("sound") != std::string::npos);
  }
  CHECK_MESSAGE(kills >= 20, "the campaign is too short to be killed often enough");
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
  CHECK(rows(folder) == undisturbed_rows(long_grid));
}

TEST_CASE("interruption: the next run takes the jobs of a dead one at once") {
  const Folder folder;
  plan(folder, long_grid);
  Program run(folder, {"run", "--workers", "2"});
  while (number(folder, "SELECT count(*) FROM jobs WHERE status = 'running'") == 0) sleep_for(5ms);
  const auto workers = run.workers();
  run.signal(SIGKILL);
  run.wait();
  wait_until_dead(workers);
  REQUIRE(number(folder, "SELECT count(*) FROM jobs WHERE status = 'running'") > 0);
  const Outcome next = campaign(folder, {"run", "--max-time", "0.5s"});
  CHECK(next.exit_code == 3);
  CHECK(next.err.find("is gone; taken back") != std::string::npos);
}

TEST_CASE("interruption: SIGINT and SIGTERM stop a run in order, and the same command goes on") {
  struct Stop {
    int signal;
    int exit_code;
  };
  const char* grid =
      R"({"e": 0.9, "n": 0.4, "N": 1000, "seeds": 2, "tau_max": 500, "sample_every": 5})";
  const std::string expected = undisturbed_rows(grid);
  for (const Stop stop : {Stop{SIGINT, 130}, Stop{SIGTERM, 143}}) {
    CAPTURE(stop.signal);
    const Folder folder;
    plan(folder, grid);
    Program run(folder, {"run", "--workers", "2"});
    while (number(folder, "SELECT max(tau_reached) FROM jobs WHERE kind = 'cooling'") == 0)
      sleep_for(5ms);
    run.signal(stop.signal);
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = run.wait();
    CHECK(outcome.exit_code == stop.exit_code);
    // The stop is prompt: a second for work worth keeping, and some more for a busy machine.
    CHECK(std::chrono::steady_clock::now() - start < 10s);  // workers get five
    CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'running'") == 0);
    CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'pending'") > 0);
    CHECK(number(folder, "SELECT sum(attempts) FROM jobs") == 0);
    CHECK(campaign(folder, {"verify"}).exit_code == 0);
    CHECK(campaign(folder, {"run"}).exit_code == 0);
    CHECK(rows(folder) == expected);
  }
}

TEST_CASE("interruption: a large gas far from its next checkpoint does not delay a stop") {
  const Folder folder;
  plan(folder, R"({"e": 0.9, "n": 0.4, "N": 400000, "seeds": 1, "tau_max": 20})");
  Program run(folder, {"run", "--workers", "1"});
  while (number(folder, "SELECT count(*) FROM jobs WHERE status = 'running'") == 0) sleep_for(5ms);
  sleep_for(200ms);
  run.signal(SIGINT);
  const auto start = std::chrono::steady_clock::now();
  CHECK(run.wait().exit_code == 130);
  CHECK(std::chrono::steady_clock::now() - start < 10s);  // workers get five
}

TEST_CASE("interruption: a worker that another program stops is replaced") {
  const Folder folder;
  plan(folder, long_grid);
  Program run(folder, {"run", "--workers", "1"});
  while (number(folder, "SELECT max(tau_reached) FROM jobs WHERE kind = 'cooling'") == 0)
    sleep_for(5ms);
  const auto before = run.workers();
  REQUIRE(before.size() == 1);
  kill(before.front(), SIGTERM);
  wait_until_dead(before);
  for (int patience = 0; patience < 200 && run.workers().empty(); ++patience) sleep_for(5ms);
  CHECK(run.workers().size() == 1);
  CHECK(number(folder, "SELECT sum(attempts) FROM jobs") == 0);
}
