// SPDX-License-Identifier: GPL-3.0-or-later

// Signals, and changes that a parent process can make to their handling.
#include <SQLiteCpp/SQLiteCpp.h>
#include <doctest/doctest.h>

#include <csignal>

#include "cli/program.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

constexpr const char* long_grid =
    R"({"e": 0.9, "n": 0.4, "N": 1000, "seeds": 2, "tau_max": 2000, "sample_every": 5})";

void plan(const Folder& folder, const std::string& grid) {
  folder.write("grid.json", grid);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
}

void wait_for_cooling(const Folder& folder) {
  while (number(folder, "SELECT max(tau_reached) FROM jobs WHERE kind = 'cooling'") == 0)
    sleep_for(5ms);
}

}  // namespace

TEST_CASE("signals: each signal that asks to stop leads to an ordered stop") {
  for (const int signal : {SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU}) {
    CAPTURE(signal);
    const Folder folder;
    plan(folder, long_grid);
    Program run(folder, {"run", "--workers", "2"});
    wait_for_cooling(folder);
    run.signal(signal);
    CHECK(run.wait().exit_code == 128 + signal);
    CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'running'") == 0);
    CHECK(number(folder, "SELECT sum(attempts) FROM jobs") == 0);
  }
}

TEST_CASE("signals: a run under nohup goes on when the terminal is gone") {
  const Folder folder;
  plan(folder, long_grid);
  Program run(folder, {"/bin/sh", "-c", "trap '' HUP; exec \"$campaign\" run --workers 1"});
  wait_for_cooling(folder);
  run.signal(SIGHUP);
  sleep_for(300ms);
  CHECK(run.runs());
}

TEST_CASE("signals: a parent that ignored SIGCHLD, or blocked SIGTERM, changes nothing") {
  const Folder folder;
  plan(folder, R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 2, "tau_max": 5})");
  CHECK(shell(folder, "trap '' CHLD; exec \"$campaign\" run").exit_code == 0);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'done'") == 4);

  const Folder other;
  plan(other, long_grid);
  Program run(other, {"/bin/sh", "-c", "trap '' CHLD TERM; exec \"$campaign\" run"});
  wait_for_cooling(other);
  run.signal(SIGTERM);
  CHECK(run.wait().exit_code == 128 + SIGTERM);
}

TEST_CASE("signals: a stop does not wait for a lock that another process holds") {
  const Folder folder;
  plan(folder, long_grid);
  Program run(folder, {"run", "--workers", "2"});
  wait_for_cooling(folder);
  {
    SQLite::Database other(folder.store().string(), SQLite::OPEN_READWRITE, 10'000);
    other.exec("BEGIN IMMEDIATE");
    sleep_for(500ms);
    run.signal(SIGINT);
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = run.wait();
    CHECK(outcome.exit_code == 130);
    CHECK(std::chrono::steady_clock::now() - start < 10s);
    CHECK(outcome.err.find("out of memory") == std::string::npos);
  }
  // The next run takes back jobs that could not be given back, at no cost.
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK(number(folder, "SELECT sum(attempts) FROM jobs") == 0);
}

TEST_CASE(
    "signals: a run with a short --max-time stores something, or says how much time it needs") {
  const Folder folder;
  plan(folder, R"({"e": 0.9, "n": 0.4, "N": 40000, "seeds": 1, "tau_max": 100})");
  const Outcome first = campaign(folder, {"run", "--workers", "1", "--max-time", "0.05s"});
  CHECK(first.exit_code == 3);
  CHECK(first.out.find("--max-time is too short") != std::string::npos);
  CHECK(number(folder, "SELECT sum(cpu_seconds) FROM jobs") == 0);

  // These jobs have no prediction, so they are begun and then stored. On a busy machine the time
  // may be over before a worker has begun: then it is doubled.
  edit_unnoticed(folder, "UPDATE jobs SET expected_cpu_seconds = NULL");
  const auto reached = [&] { return number(folder, "SELECT total(tau) FROM checkpoints"); };
  double before = 0;
  for (int i = 0; i < 3; ++i) {
    for (double seconds = 0.3; reached() == before && seconds < 60; seconds *= 2) {
      const std::string limit = std::to_string(seconds) + "s";
      CHECK(campaign(folder, {"run", "--workers", "1", "--max-time", limit}).exit_code == 3);
      // A run that has spent CPU time has stored something.
      CHECK((number(folder, "SELECT total(cpu_seconds) FROM jobs") > 0) == (reached() > 0));
    }
    CHECK(reached() > before);
    before = reached();
  }
}
