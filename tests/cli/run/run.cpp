// SPDX-License-Identifier: GPL-3.0-or-later

#include <doctest/doctest.h>

#include <csignal>
#include <string>

#include "cli/program.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

// Some 0.2 s of work in four cooling jobs.
constexpr const char* grid = R"({"e": [0.8, 0.9], "n": 0.4, "N": 500, "seeds": 2, "tau_max": 105})";

// A worker needs seconds before it can store anything.
constexpr const char* slow = R"({"e": 0.9, "n": 0.4, "N": 400000, "seeds": 1, "tau_max": 20})";

Outcome run(const Folder& folder, const char* text, std::vector<std::string> words = {"run"}) {
  folder.write("grid.json", text);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  return campaign(folder, std::move(words));
}

std::string rows_of_run(const char* text, std::vector<std::string> words = {"run"}) {
  const Folder folder;
  REQUIRE(run(folder, text, std::move(words)).exit_code == 0);
  return rows(folder);
}

}  // namespace

TEST_CASE("run: completes a campaign, and verify accepts it") {
  const Folder folder;
  const Outcome outcome = run(folder, grid);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.find("published") != std::string::npos);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'done'") == 6);
  CHECK(number(folder,
               "SELECT count(*) FROM samples JOIN jobs USING (job_id) "
               "WHERE kind = 'cooling'") == 4 * 106);
  CHECK(number(folder, "SELECT count(*) FROM results") == 4);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
}

TEST_CASE("run: without a store says how to make one") {
  const Folder folder;
  const Outcome outcome = campaign(folder, {"run"});
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.err.find("campaign plan GRID.json") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder.store()));
}

TEST_CASE("run: with nothing to do is complete") {
  const Folder folder;
  run(folder, grid);
  CHECK(campaign(folder, {"run"}).exit_code == 0);
}

TEST_CASE("run: rows do not depend on the number of workers") {
  CHECK(rows_of_run(grid, {"run", "--workers", "1"}) ==
        rows_of_run(grid, {"run", "--workers", "5"}));
}

TEST_CASE("run: rows do not depend on checkpoint_every") {
  const std::string rows = rows_of_run(grid);
  for (const char* every : {"1", "35", "1000"}) {
    CAPTURE(every);
    const std::string other = std::string(R"({"e": [0.8, 0.9], "n": 0.4, "N": 500, "seeds": 2,)") +
                              R"( "tau_max": 105, "checkpoint_every": )" + every + "}";
    CHECK(rows_of_run(other.c_str()) == rows);
  }
}

TEST_CASE("run: a larger tau_max gives the rows of one long run") {
  const Folder folder;
  run(folder, R"({"e": [0.8, 0.9], "n": 0.4, "N": 500, "seeds": 2, "tau_max": 37})");
  CHECK(run(folder, grid).exit_code == 0);
  CHECK(rows(folder) == rows_of_run(grid));
}

TEST_CASE("run: a larger tau_max goes on from the last checkpoint") {
  const Folder folder;
  run(folder, R"({"e": [0.8, 0.9], "n": 0.4, "N": 500, "seeds": 2, "tau_max": 37})");
  // If this row, before the checkpoint at tau = 30, were computed again, it would not agree.
  edit_unnoticed(folder, "UPDATE samples SET time = time + 1 WHERE tau = 20");
  CHECK(run(folder, grid).exit_code == 0);
}

TEST_CASE("run: a row that differs when computed again counts as damaged") {
  const Folder folder;
  run(folder, R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 1, "tau_max": 37})");
  // This row, after the checkpoint at tau = 30, is computed again and compared.
  edit_unnoticed(folder, "UPDATE samples SET time = time + 1 WHERE tau = 35");
  const Outcome outcome =
      run(folder, R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 1, "tau_max": 50})");
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out.find("35") != std::string::npos);
}

TEST_CASE("run: two runs share a store and never do a job twice") {
  const Folder folder;
  folder.write("grid.json", grid);
  campaign(folder, {"plan", "grid.json"});
  Program first(folder, {"run", "--workers", "2"});
  Program second(folder, {"run", "--workers", "2"});
  CHECK(first.wait().exit_code == 0);
  CHECK(second.wait().exit_code == 0);
  CHECK(number(folder, "SELECT max(lease) FROM jobs") == 1);
  CHECK(rows(folder) == rows_of_run(grid));
}

TEST_CASE("run: --max-time ends with 3 while work is left") {
  const Folder folder;
  const Outcome outcome = run(folder, slow, {"run", "--max-time", "0.3s"});
  CHECK(outcome.exit_code == 3);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'pending'") == 2);
}

TEST_CASE("run: a job whose workers crash fails with the reason, and retry reopens it") {
  const Folder folder;
  folder.write("grid.json", slow);
  campaign(folder, {"plan", "grid.json"});
  Program run(folder, {"run", "--workers", "1"});
  for (int crashes = 0; crashes < 3 && run.runs();) {
    sleep_for(100ms);
    if (number(folder, "SELECT count(*) FROM jobs WHERE status = 'running'") == 0) continue;
    for (const pid_t worker : run.workers()) kill(worker, SIGABRT);
    ++crashes;
    while (run.runs() && number(folder, "SELECT max(attempts) FROM jobs") < crashes) sleep_for(5ms);
  }
  const Outcome outcome = run.wait();
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out.find("signal 6") != std::string::npos);
  CHECK(outcome.out.find("1 cooling job is blocked: the equilibration, job 1, failed") !=
        std::string::npos);
  CHECK(campaign(folder, {"run"}).exit_code == 1);  // nothing can be run
  CHECK(campaign(folder, {"retry"}).out.find("1 failed job reopened") != std::string::npos);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'pending'") == 2);
}

TEST_CASE("run: a failed job does not keep the others from being run") {
  const Folder folder;
  folder.write("grid.json", grid);
  campaign(folder, {"plan", "grid.json"});
  edit_unnoticed(folder,
                 "UPDATE jobs SET status = 'failed', error = 'for a test' WHERE job_id = 1");
  const Outcome outcome = campaign(folder, {"run"});
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out.find("for a test") != std::string::npos);
  CHECK(outcome.out.find("campaign retry") != std::string::npos);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'done'") == 3);
}
