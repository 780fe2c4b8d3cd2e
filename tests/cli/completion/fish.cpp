// SPDX-License-Identifier: GPL-3.0-or-later

// The completions that fish itself gives.
#include <doctest/doctest.h>

#include <string>

#include "cli/completion/expected.hpp"
#include "cli/program.hpp"

using namespace haff::tests;

namespace {

// The completions that fish offers after these words, separated by blanks, without descriptions.
std::string completed(const Folder& folder, const std::string& words) {
  folder.write("words", words);
  const Outcome outcome =
      shell(folder,
            "\"$campaign\" document fish > completion && XDG_CONFIG_HOME=$PWD XDG_DATA_HOME=$PWD "
            "fish --no-config -c 'source completion; complete -C (cat words | string collect)' "
            "| cut -f 1 | paste -s -d ' '");
  return outcome.out.substr(0, outcome.out.find('\n'));
}

}  // namespace

TEST_CASE("completion: fish completes commands, options, their values and files") {
  const Folder folder;
  if (shell(folder, "command -v fish").exit_code != 0) {
    MESSAGE("Skipped: there is no fish");
    return;
  }
  folder.write("grid.json", "{}");
  for (const Completion& each : expected_completions) {
    CAPTURE(each.words);
    CHECK(completed(folder, std::string("campaign ") + each.words) == each.given);
  }
  CHECK(completed(folder, "campaign --store=grid.j") == "--store=grid.json");
}
