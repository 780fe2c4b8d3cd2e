// SPDX-License-Identifier: GPL-3.0-or-later

// The completions of fish, asked of fish itself.
#include <doctest/doctest.h>

#include <string>

#include "cli/program.hpp"

using namespace haff::tests;

namespace {

// What fish offers after these words, a line each, without descriptions.
std::string completed(const Folder& folder, const std::string& words) {
  folder.write("words", words);
  return shell(
             folder,
             "\"$campaign\" document fish > completion && XDG_CONFIG_HOME=$PWD XDG_DATA_HOME=$PWD "
             "fish --no-config -c 'source completion; complete -C (cat words | string collect)' "
             "| cut -f 1")
      .out;
}

}  // namespace

TEST_CASE("completion: fish completes commands, options, their values and files") {
  const Folder folder;
  if (shell(folder, "command -v fish").exit_code != 0) {
    MESSAGE("Skipped: there is no fish");
    return;
  }
  folder.write("grid.json", "{}");
  CHECK(completed(folder, "campaign ret") == "retry\n");
  CHECK(completed(folder, "campaign pl") == "plan\nplot\n");
  CHECK(completed(folder, "campaign --store grid.json ret") == "retry\n");
  CHECK(completed(folder, "campaign run ret") == "");
  CHECK(completed(folder, "campaign run --bud") == "--budget\n");
  CHECK(completed(folder, "campaign run --st") == "--store\n");
  CHECK(completed(folder, "campaign query --format j") == "json\n");
  CHECK(completed(folder, "campaign plan gr") == "grid.json\n");
  CHECK(completed(folder, "campaign --store grid.j") == "grid.json\n");
  CHECK(completed(folder, "campaign --store=grid.j") == "--store=grid.json\n");
  CHECK(completed(folder, "campaign run --max-time ") == "");  // a time cannot be guessed
}
