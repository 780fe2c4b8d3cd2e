// SPDX-License-Identifier: GPL-3.0-or-later

// The store as a file: named, copied, moved and deleted by people while the program uses it.
#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>

#include "cli/program.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

// Some seconds of work.
constexpr const char* grid =
    R"({"e": 0.9, "n": 0.4, "N": 1000, "seeds": 4, "tau_max": 1500, "sample_every": 10})";
constexpr const char* short_grid = R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 2, "tau_max": 5})";

void plan(const Folder& folder, const char* text) {
  folder.write("grid.json", text);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
}

void wait_for_work(const Folder& folder) {
  while (number(folder, "SELECT max(tau_reached) FROM jobs WHERE kind = 'cooling'") == 0)
    sleep_for(5ms);
}

// Checks a run whose store this command takes away.
void check_loss_of_store(const std::string& command, const std::string& what) {
  CAPTURE(command);
  const Folder folder;
  plan(folder, grid);
  shell(folder, "cp campaign.db old.db");
  Program run(folder, {"run", "--workers", "1"});
  wait_for_work(folder);
  shell(folder, command);
  const auto start = std::chrono::steady_clock::now();
  const Outcome outcome = run.wait();
  CHECK(std::chrono::steady_clock::now() - start < 20s);
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.err.find("campaign.db " + what) != std::string::npos);
  REQUIRE(outcome.err.find("campaign.db.rescued-1") != std::string::npos);
  const Outcome saved = campaign(folder, {"verify", "--store", "campaign.db.rescued-1"});
  CHECK(saved.exit_code == 0);
  const Outcome samples = campaign(folder, {"query", "SELECT count(*) > 10 FROM samples",
                                            "--format", "csv", "--store", "campaign.db.rescued-1"});
  CHECK(samples.out.find("\n1") != std::string::npos);
}

}  // namespace

TEST_CASE("store file: the loss of the store during a run is noticed, and the store is saved") {
  check_loss_of_store("rm campaign.db*", "was deleted or moved away");
  check_loss_of_store("mv campaign.db other.db", "was deleted or moved away");
  check_loss_of_store("mv old.db campaign.db", "was replaced by another file");
  check_loss_of_store("cp old.db campaign.db", "was written over by another program");
}

TEST_CASE("store file: a backup during a run is sound and can be run") {
  const Folder folder;
  plan(folder, grid);
  Program run(folder, {"run", "--workers", "1"});
  wait_for_work(folder);
  CHECK(campaign(folder, {"backup", "copy.db"}).exit_code == 0);
  CHECK(campaign(folder, {"verify", "--store", "copy.db"}).exit_code == 0);
  CHECK(campaign(folder, {"run", "--store", "copy.db", "--max-time", "0.5s"}).exit_code != 1);
  const Outcome again = campaign(folder, {"backup", "copy.db"});
  CHECK(again.exit_code == 2);
  CHECK(again.err.find("exists already") != std::string::npos);
  run.signal(SIGTERM);
  CHECK(run.wait().exit_code == 143);
}

TEST_CASE("store file: a file that replaced a running store stays as it was") {
  for (const char* command : {"mv old.db campaign.db", "cp old.db campaign.db"}) {
    CAPTURE(std::string(command));
    const Folder folder;
    plan(folder, grid);
    shell(folder, "cp campaign.db old.db; cp campaign.db same.db");
    Program run(folder, {"run", "--workers", "1"});
    wait_for_work(folder);
    shell(folder, command);
    CHECK(run.wait().exit_code == 1);
    CHECK(shell(folder, "cmp campaign.db same.db").exit_code == 0);
    CHECK_FALSE(std::filesystem::exists(folder / "campaign.db-wal"));
  }
}

TEST_CASE("store file: a run whose store is emptied does not succeed") {
  const Folder folder;
  plan(folder, grid);
  Program run(folder, {"run", "--workers", "1"});
  wait_for_work(folder);
  shell(folder, ": > campaign.db");
  const Outcome outcome = run.wait();
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.err.find("campaign.db was written over by another program") != std::string::npos);
}

TEST_CASE("store file: a backup put over a killed run is not mixed with the log beside it") {
  const Folder folder;
  plan(folder, grid);
  shell(folder, "cp campaign.db backup.db");
  {
    const Program run(folder, {"run", "--workers", "1"});
    wait_for_work(folder);
    for (const pid_t worker : run.workers()) kill(worker, SIGKILL);
  }  // the run itself is killed, too
  REQUIRE(std::filesystem::exists(folder / "campaign.db-wal"));
  shell(folder, "cp backup.db campaign.db");
  for (const char* command : {"status", "verify", "run", "retry"}) {
    CAPTURE(std::string(command));
    const Outcome outcome = campaign(folder, {command});
    CHECK(outcome.exit_code == 1);
    CHECK((outcome.out + outcome.err).find("is that of another file") != std::string::npos);
  }
  shell(folder, "mv campaign.db-wal away");
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
}

TEST_CASE(
    "store file: a backup that replaces the store of a killed plan is not mixed with its journal") {
  const Folder folder;
  plan(folder, short_grid);
  shell(folder, "cp campaign.db early.db");
  plan(folder, R"({"e": 0.9, "n": 0.4, "N": 500, "seeds": 1, "tau_max": 5})");
  REQUIRE(campaign(folder, {"backup", "backup.db"}).exit_code == 0);
  // A transaction that has reached the file, since memory holds few of its pages, when power fails.
  shell(folder, R"(sqlite3 campaign.db "PRAGMA cache_size = 1; BEGIN;
      UPDATE jobs SET error = hex(randomblob(20000));" \
      ".shell cp campaign.db cut.db; cp campaign.db-journal cut.db-journal")");
  REQUIRE(std::filesystem::exists(folder / "cut.db-journal"));
  shell(folder, "mkdir put; cp cut.db* put");
  // The journal is its own, and is undone.
  CHECK(campaign(folder, {"verify", "--store", "put/cut.db"}).exit_code == 0);
  for (const char* copy : {"early.db", "backup.db"}) {
    CAPTURE(std::string(copy));
    shell(folder, std::string("rm put/*; cp cut.db-journal put; cp ") + copy + " put/cut.db");
    for (const char* command : {"status", "verify", "run", "retry"}) {
      CAPTURE(std::string(command));
      const Outcome outcome = campaign(folder, {command, "--store", "put/cut.db"});
      CHECK(outcome.exit_code == 1);
      CHECK((outcome.out + outcome.err).find("is that of another file") != std::string::npos);
    }
    CHECK(shell(folder, std::string("cmp put/cut.db ") + copy).exit_code == 0);
    shell(folder, "rm put/cut.db-journal");
    CHECK(campaign(folder, {"verify", "--store", "put/cut.db"}).exit_code == 0);
  }
}

TEST_CASE("store file: a copy made without its log is recognized") {
  const Folder folder;
  plan(folder, grid);
  Program run(folder, {"run", "--workers", "1"});
  wait_for_work(folder);
  shell(folder, "kill -STOP " + std::to_string(run.id()) + "; sleep 0.1; cp campaign.db copy.db; " +
                    "kill -CONT " + std::to_string(run.id()));
  run.signal(SIGTERM);
  CHECK(run.wait().exit_code == 143);
  const Outcome verified = campaign(folder, {"verify", "--store", "copy.db"});
  CHECK(verified.exit_code == 1);
  CHECK(verified.out.find("Its newest rows may be missing") != std::string::npos);
  const Outcome status = campaign(folder, {"status", "--store", "copy.db"});
  CHECK(status.exit_code == 0);
  CHECK(status.err.find("its newest rows may be missing") != std::string::npos);
  CHECK(campaign(folder, {"run", "--store", "copy.db", "--max-time", "0.5s"}).exit_code != 1);
  CHECK(campaign(folder, {"verify", "--store", "copy.db"}).exit_code == 0);
}

TEST_CASE("store file: after a run there is no log beside it") {
  const Folder folder;
  plan(folder, short_grid);
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK_FALSE(std::filesystem::exists(folder / "campaign.db-wal"));
  CHECK_FALSE(std::filesystem::exists(folder / "campaign.db-shm"));
}

TEST_CASE("store file: a path that is not a file is bad input, a store with two names a failure") {
  const Folder folder;
  folder.write("grid.json", short_grid);
  shell(folder, "mkfifo pipe; mkdir folder");
  for (const char* name : {"", "pipe", "folder", "c/", "no/c.db"}) {
    CAPTURE(std::string(name));
    CHECK(campaign(folder, {"plan", "grid.json", "--store", name}).exit_code == 2);
    CHECK(campaign(folder, {"status", "--store", name}).exit_code == 2);
  }
  plan(folder, short_grid);
  shell(folder, "ln campaign.db second.db");
  CHECK(campaign(folder, {"run"}).exit_code == 1);
  CHECK(campaign(folder, {"status"}).exit_code == 0);
}
