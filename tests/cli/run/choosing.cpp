// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign run --where` and `--order` choose jobs; `campaign cancel` and `plan --replace` remove
// jobs that are no longer wanted.
#include <doctest/doctest.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/program.hpp"

using namespace haff::tests;
using namespace std::chrono_literals;

namespace {

constexpr const char* grid = R"({"e": [0.8, 0.9], "n": 0.4, "N": 500, "seeds": 2, "tau_max": 25})";

// A worker needs seconds before it can store anything.
constexpr const char* slow = R"({"e": 0.9, "n": 0.4, "N": 400000, "seeds": 1, "tau_max": 20})";

void plan(const Folder& folder, const char* text = grid) {
  folder.write("grid.json", text);
  REQUIRE(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
}

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

double jobs(const Folder& folder, const std::string& where) {
  return number(folder, "SELECT count(*) FROM jobs WHERE " + where);
}

}  // namespace

TEST_CASE("run --where runs the chosen jobs with their equilibrations, and counts the rest") {
  const Folder folder;
  plan(folder);
  const Outcome outcome =
      campaign(folder, {"run", "--workers", "2", "--where", "e = 0.9 AND seed = 2"});
  CHECK(outcome.exit_code == 0);
  CHECK(contains(outcome.out, "4 pending jobs were not chosen by --where, and stay pending"));
  CHECK(jobs(folder, "status = 'done'") == 2);
  CHECK(jobs(folder, "status = 'done' AND seed = 2 AND (kind = 'equilibration' OR e = 0.9)") == 2);
}

TEST_CASE("run --where: rows are the same as in a run of all jobs") {
  const Folder chosen, all;
  plan(chosen);
  plan(all);
  for (const char* where : {"e = 0.9", "seed = 1", "e < 0.85"})
    CHECK(campaign(chosen, {"run", "--where", where, "--order", "seed DESC"}).exit_code == 0);
  CHECK(campaign(all, {"run"}).exit_code == 0);
  CHECK(rows(chosen) == rows(all));
}

TEST_CASE("run --order takes jobs in this order") {
  const Folder folder;
  plan(folder);
  CHECK(campaign(folder, {"run", "--workers", "1", "--order", "seed DESC, e"}).exit_code == 0);
  CHECK(number(folder,
               "SELECT max(started) FILTER (WHERE seed = 2) < min(started) FILTER (WHERE seed = 1) "
               "FROM jobs") == 1);
}

TEST_CASE("run --where: SQL that is not a condition, or that no job fulfils, is refused") {
  const Folder folder;
  plan(folder);
  for (const char* where : {"e =", "1); DELETE FROM jobs; --", "e", "sed = 1", "e = 0.85", " "}) {
    CAPTURE(where);
    const Outcome outcome = campaign(folder, {"run", "--where", where});
    CHECK(outcome.exit_code == 2);
    CHECK(contains(outcome.err, "--where"));
  }
  CHECK(campaign(folder, {"run", "--order", "sed"}).exit_code == 2);
  CHECK(jobs(folder, "status = 'pending'") == 6);
}

TEST_CASE("run --where: targets of chosen gases get their realizations, and others wait") {
  const Folder folder;
  plan(folder, R"({"e": [0.8, 0.9], "n": 0.4, "N": 500, "seeds": 5, "tau_max": 10,
                   "target": {"a2": {"tau": [5, 10], "se": 0.01}}})");
  REQUIRE(campaign(folder, {"run", "--where", "e = 0.8"}).exit_code == 0);
  CHECK(jobs(folder, "e = 0.8 AND status <> 'done'") == 0);
  CHECK(jobs(folder, "e = 0.9") == 5);
  CHECK(jobs(folder, "e = 0.9 AND status = 'pending'") == 5);
}

TEST_CASE("run --json says how many jobs were not chosen") {
  const Folder folder;
  plan(folder);
  const Outcome outcome = campaign(folder, {"run", "--where", "e = 0.8", "--json"});
  CHECK(nlohmann::json::parse(outcome.out).at("not_chosen") == 2);
}

TEST_CASE("cancel: planned jobs are removed, and --dry-run only says so") {
  const Folder folder;
  plan(folder);
  const Outcome seen = campaign(folder, {"cancel", "--where", "e = 0.8", "--dry-run"});
  CHECK(seen.exit_code == 0);
  CHECK(contains(seen.out, "2 jobs would be removed.\nNothing was changed."));
  CHECK(jobs(folder, "1") == 6);
  const Outcome done = campaign(folder, {"cancel", "--where", "e = 0.8"});
  CHECK(done.exit_code == 0);
  CHECK(contains(done.out, "2 jobs removed."));
  CHECK(jobs(folder, "1") == 4);
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
}

TEST_CASE("cancel --delete removes done jobs with all their data, and makes the file smaller") {
  const Folder folder;
  plan(folder, R"({"e": [0.8, 0.9], "n": 0.4, "N": 4000, "seeds": 2, "tau_max": 12})");
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
  const auto before = std::filesystem::file_size(folder.store());
  const Outcome kept = campaign(folder, {"cancel", "--where", "seed = 2"});
  CHECK(kept.exit_code == 0);
  CHECK(contains(kept.out, "2 kept (--delete removes the done)"));
  CHECK(std::filesystem::file_size(folder.store()) == before);
  const Outcome gone = campaign(folder, {"cancel", "--where", "seed = 2", "--delete"});
  CHECK(gone.exit_code == 0);
  CHECK(contains(gone.out, "3 jobs removed."));
  CHECK(contains(gone.out, "given back to the disk"));
  CHECK(std::filesystem::file_size(folder.store()) < 0.7 * static_cast<double>(before));
  CHECK(number(folder, "SELECT count(DISTINCT job_id) FROM samples") == 3);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
  CHECK(campaign(folder, {"plan", "grid.json"}).exit_code == 0);
  CHECK(campaign(folder, {"run"}).exit_code == 0);
}

TEST_CASE("cancel leaves a running job alone, and names its process") {
  const Folder folder;
  plan(folder, slow);
  Program run(folder, {"run", "--workers", "1"});
  while (jobs(folder, "status = 'running'") == 0) sleep_for(5ms);
  const Outcome outcome = campaign(folder, {"cancel", "--where", "kind = 'equilibration'"});
  CHECK(outcome.exit_code == 1);
  CHECK(contains(outcome.out, "is being run by process"));
  // Its cooling job is only planned, and is removed meanwhile.
  CHECK(campaign(folder, {"cancel", "--where", "e = 0.9"}).exit_code == 0);
  CHECK(jobs(folder, "1") == 1);
  run.signal(SIGTERM);
  run.wait();
}

TEST_CASE("cancel: a begun job ends where it is stored, and the next run completes it") {
  const Folder folder;
  plan(folder, R"({"e": 0.9, "n": 0.4, "N": 500, "seeds": 1, "tau_max": 25})");
  REQUIRE(campaign(folder, {"run"}).exit_code == 0);
  plan(folder, R"({"e": 0.9, "n": 0.4, "N": 500, "seeds": 1, "tau_max": 1000000})");
  const Outcome outcome = campaign(folder, {"cancel", "--where", "e = 0.9"});
  CHECK(contains(outcome.out, "it ends at tau = 25"));
  CHECK(campaign(folder, {"run"}).exit_code == 0);
  CHECK(jobs(folder, "kind = 'cooling' AND status = 'done' AND tau_max = 25") == 1);
  CHECK(campaign(folder, {"verify"}).exit_code == 0);
}

TEST_CASE("cancel --json") {
  const Folder folder;
  plan(folder);
  const Outcome outcome = campaign(folder, {"cancel", "--where", "e = 0.8", "--dry-run", "--json"});
  const auto object = nlohmann::json::parse(outcome.out);
  CHECK(object.at("removed") == 2);
  CHECK(object.at("jobs").size() == 2);
  CHECK(object.at("jobs").at(0).at("fate") == "removed");
  CHECK(object.at("bytes_given_back").is_null());
}

TEST_CASE("plan --replace: the grid replaces what is planned") {
  const Folder folder;
  plan(folder);
  REQUIRE(campaign(folder, {"run", "--where", "e = 0.8"}).exit_code == 0);
  folder.write("other.json", R"({"e": 0.95, "n": 0.4, "N": 500, "seeds": 1, "tau_max": 25})");
  const Outcome seen = campaign(folder, {"plan", "other.json", "--replace", "--dry-run"});
  CHECK(contains(seen.out, "is done"));
  CHECK(jobs(folder, "1") == 6);
  const Outcome outcome = campaign(folder, {"plan", "other.json", "--replace"});
  CHECK(outcome.exit_code == 0);
  CHECK(jobs(folder, "e = 0.9") == 0);
  CHECK(jobs(folder, "e = 0.8 AND status = 'done'") == 2);
  CHECK(jobs(folder, "e = 0.95 AND status = 'pending'") == 1);
}

TEST_CASE("plan: a smaller tau_max has an effect only with --replace, and plan says so") {
  const Folder folder;
  plan(folder);
  folder.write("shorter.json",
               R"({"e": [0.8, 0.9], "n": 0.4, "N": 500, "seeds": 2, "tau_max": 10})");
  const Outcome added = campaign(folder, {"plan", "shorter.json"});
  CHECK(contains(added.out, "4 jobs are already planned to a larger tau_max than this grid has"));
  CHECK(jobs(folder, "kind = 'cooling' AND tau_max = 25") == 4);
  const Outcome replaced = campaign(folder, {"plan", "shorter.json", "--replace", "--json"});
  CHECK(nlohmann::json::parse(replaced.out).at("replaced").at("ends") == 4);
  CHECK(jobs(folder, "kind = 'cooling' AND tau_max = 10") == 4);
}
