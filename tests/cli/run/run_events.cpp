// SPDX-License-Identifier: GPL-3.0-or-later

// Reports of a run to other programs: --log-json and --on-finish.
#include <doctest/doctest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/program.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;
using nlohmann::json;

namespace {

std::vector<json> events(const std::filesystem::path& file) {
  std::vector<json> all;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) all.push_back(json::parse(line));
  return all;
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::size_t count(const std::vector<json>& all, const std::string& event) {
  std::size_t found = 0;
  for (const json& one : all) found += one["event"] == event;
  return found;
}

void plan(const Folder& folder, const std::string& grid) {
  folder.write("grid.json", grid);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
}

const std::string small = R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 2, "tau_max": 20})";

}  // namespace

TEST_CASE("run --log-json: one line per event, from start to end, and further runs are appended") {
  const Folder folder;
  plan(folder, small);
  REQUIRE(campaign(folder, {"run", "--log-json", "run.jsonl"}).exit_code == 0);
  const std::vector<json> all = events(folder / "run.jsonl");
  REQUIRE(all.size() >= 6);
  CHECK(all.front()["event"] == "run_started");
  CHECK(all.back()["event"] == "run_ended");
  CHECK(all.back()["exit_code"] == 0);
  CHECK(all.back()["done"] == 4);
  CHECK(count(all, "job_begun") == 4);
  CHECK(count(all, "job_done") == 4);
  for (const json& one : all) CHECK(one["time"].get<std::string>().back() == 'Z');
  REQUIRE(campaign(folder, {"run", "--log-json", "run.jsonl"}).exit_code == 0);
  CHECK(count(events(folder / "run.jsonl"), "run_started") == 2);
}

TEST_CASE("run --log-json: a file that cannot be opened is reported before any job runs") {
  const Folder folder;
  plan(folder, small);
  const Outcome outcome = campaign(folder, {"run", "--log-json", "no/such/folder.jsonl"});
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.err.find("no/such/folder.jsonl") != std::string::npos);
  CHECK(number(folder, "SELECT count(*) FROM jobs WHERE status = 'pending'") == 4);
}

TEST_CASE("run --log-json: a full disk ends the log, not the run") {
  const Folder folder;
  plan(folder, small);
  const Outcome outcome = campaign(folder, {"run", "--log-json", "/dev/full"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.find("goes on without it") != std::string::npos);
}

TEST_CASE(
    "run --on-finish: the command learns how the run ended, and does not change the exit code") {
  const Folder folder;
  plan(folder, small);
  const Outcome outcome = campaign(
      folder,
      {"run", "--on-finish",
       "echo $CAMPAIGN_EXIT_CODE $CAMPAIGN_DONE $CAMPAIGN_FAILED $CAMPAIGN_PENDING > told; "
       "test -f \"$CAMPAIGN_STORE\" && case $CAMPAIGN_STORE in /*) echo found >> told;; esac; "
       "exit 7"});
  CHECK(outcome.exit_code == 0);
  CHECK(text_of(folder / "told") == "0 4 0 0\nfound\n");
  CHECK(outcome.err.find("exit code 7") != std::string::npos);
}

TEST_CASE("run --on-finish: the command also runs after an interruption, or without a store") {
  const Folder folder;
  CHECK(campaign(folder, {"run", "--on-finish", "echo $CAMPAIGN_EXIT_CODE > told"}).exit_code != 0);
  CHECK(text_of(folder / "told") != "0\n");

  plan(folder, R"({"e": 0.8, "n": 0.4, "N": 20000, "seeds": 4, "tau_max": 2000})");
  Program run(folder, {"run", "--workers", "1", "--on-finish", "echo $CAMPAIGN_EXIT_CODE > told"});
  for (int k = 0; k < 200 && run.workers().empty(); ++k) sleep_for(50ms);
  run.signal(SIGTERM);
  CHECK(run.wait().exit_code == 128 + SIGTERM);
  CHECK(text_of(folder / "told") == "143\n");
}

TEST_CASE("status --watch: plain text without a terminal, and an end at a signal") {
  const Folder folder;
  plan(folder, small);
  Program watch(folder, {"status", "--watch", "0.2s"});
  sleep_for(1500ms);
  watch.signal(SIGINT);
  const Outcome outcome = watch.wait();
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.find('\x1b') == std::string::npos);
  const std::size_t first = outcome.out.find("jobs, 0.0 % of the work done");
  REQUIRE(first != std::string::npos);
  CHECK(outcome.out.find("jobs, 0.0 % of the work done", first + 1) != std::string::npos);
}

TEST_CASE("status --watch --json: one line each time; a bad time is bad input") {
  const Folder folder;
  plan(folder, small);
  Program watch(folder, {"status", "--json", "--watch"});
  sleep_for(1000ms);
  watch.signal(SIGTERM);
  const Outcome outcome = watch.wait();
  CHECK(outcome.exit_code == 0);
  CHECK(json::parse(outcome.out.substr(0, outcome.out.find('\n')))["jobs"]["pending"] == 4);
  CHECK(campaign(folder, {"status", "--watch", "often"}).exit_code == 2);
}
