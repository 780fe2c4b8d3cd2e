// SPDX-License-Identifier: GPL-3.0-or-later

// The man page and the completions that the program makes from its own command line.
#include <doctest/doctest.h>

#include <sstream>
#include <string>
#include <vector>

#include "cli/program.hpp"

using namespace haff::tests;

namespace {

// The first words of the lines of --help that follow "Subcommands:".
std::vector<std::string> commands(const Folder& folder) {
  std::istringstream help(campaign(folder, {"--help"}).out);
  std::vector<std::string> names;
  bool listed = false;
  for (std::string line; std::getline(help, line);) {
    if (listed && line.empty()) break;
    if (listed) names.push_back(line.substr(2, line.find(' ', 2) - 2));
    listed = listed || line == "Subcommands:";
  }
  return names;
}

bool contains(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

}  // namespace

TEST_CASE("documents: each names every command that is not hidden") {
  const Folder folder;
  const auto names = commands(folder);
  REQUIRE(names.size() > 10);
  for (const char* kind : {"man", "bash", "zsh", "fish"}) {
    CAPTURE(kind);
    const Outcome outcome = campaign(folder, {"document", kind});
    CHECK(outcome.exit_code == 0);
    for (const std::string& name : names) {
      CAPTURE(name);
      CHECK(contains(outcome.out, name));
    }
    CHECK(!contains(outcome.out, "DESCRIPTOR"));
    CHECK(contains(outcome.out, "max"));
  }
  CHECK(campaign(folder, {"document", "html"}).exit_code == 2);
}
