// SPDX-License-Identifier: GPL-3.0-or-later

#include <doctest/doctest.h>

#include "cli/program.hpp"

using namespace haff::tests;

namespace {

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("command line: every command has help with examples") {
  const Folder folder;
  for (const char* command :
       {"plan", "run", "status", "query", "figures", "cost", "verify", "retry"}) {
    CAPTURE(command);
    const Outcome outcome = campaign(folder, {command, "--help"});
    CHECK(outcome.exit_code == 0);
    CHECK(contains(outcome.out, "Examples:\n  campaign "));
    CHECK(outcome.err.empty());
  }
}

TEST_CASE("command line: --version names commit, compiler and SIMD target") {
  const Folder folder;
  const Outcome outcome = campaign(folder, {"--version"});
  CHECK(outcome.exit_code == 0);
  for (const char* part : {"campaign ", "commit ", "compiler ", "SIMD "})
    CHECK(contains(outcome.out, part));
}

TEST_CASE("command line: a bad command line ends with 2 and names the help") {
  const Folder folder;
  struct Bad {
    std::vector<std::string> words;
    const char* message;
  };
  for (const Bad& bad : {Bad{{"fly"}, "fly"}, Bad{{"run", "--workers", "0"}, "campaign run --help"},
                         Bad{{"run", "--max-time", "soon"}, "'soon' is no duration"},
                         Bad{{"query"}, "campaign query --help"},
                         Bad{{"query", "SELECT 1", "--format", "xml"}, "xml"},
                         Bad{{"plan"}, "campaign plan --help"}}) {
    CAPTURE(bad.words.front());
    const Outcome outcome = campaign(folder, bad.words);
    CHECK(outcome.exit_code == 2);
    CHECK(contains(outcome.err, bad.message));
    CHECK(outcome.out.empty());
  }
}

TEST_CASE("command line: a file that is not a store is bad input for every command") {
  const Folder folder;
  folder.write("grid.json", R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 1, "tau_max": 5})");
  for (const char* command : {"run", "status", "retry", "figures"}) {
    CAPTURE(command);
    const Outcome outcome = campaign(folder, {command, "--store", "grid.json"});
    CHECK(outcome.exit_code == 2);
    CHECK(contains(outcome.err, "grid.json"));
  }
}

TEST_CASE("command line: --store may stand before or after the command") {
  const Folder folder;
  folder.write("grid.json", R"({"e": 0.8, "n": 0.4, "N": 500, "seeds": 1, "tau_max": 5})");
  CHECK(campaign(folder, {"--store", "a.db", "plan", "grid.json"}).exit_code == 0);
  CHECK(campaign(folder, {"plan", "grid.json", "--store", "b.db"}).exit_code == 0);
  CHECK(std::filesystem::exists(folder / "a.db"));
  CHECK(std::filesystem::exists(folder / "b.db"));
}
