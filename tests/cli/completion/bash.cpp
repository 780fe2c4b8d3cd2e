// SPDX-License-Identifier: GPL-3.0-or-later

// The completions of bash, as its function gives them.
#include <doctest/doctest.h>

#include <string>

#include "cli/completion/expected.hpp"
#include "cli/program.hpp"

using namespace haff::tests;

namespace {

// The completions that bash offers after these words of its own, in which = stands alone and a word
// not yet begun is ''.
std::string completed(const Folder& folder, const std::string& words) {
  folder.write("complete",
               "compopt() { :; }  # works only while a user completes\n"
               ". ./completion\n"
               "COMP_WORDS=(campaign " +
                   words +
                   ")\n"
                   "COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
                   "_campaign\n"
                   "echo ${COMPREPLY[@]}\n");
  return shell(folder, "$campaign document bash > completion && bash complete").out;
}

}  // namespace

TEST_CASE("completion: bash completes commands, options, their values and files") {
  const Folder folder;
  folder.write("grid.json", "{}");
  for (const Completion& each : expected_completions) {
    CAPTURE(each.words);
    const std::string words = each.words;
    CHECK(completed(folder, words.ends_with(' ') ? words + "''" : words) ==
          std::string(each.given) + "\n");
  }
  CHECK(completed(folder, "run --store = grid.j") == "grid.json\n");
  CHECK(completed(folder, "query --format =") == "table csv json\n");
}
