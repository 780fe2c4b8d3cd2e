// SPDX-License-Identifier: GPL-3.0-or-later

// The completions of zsh, typed into a zsh on a terminal.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "cli/completion/expected.hpp"
#include "cli/program.hpp"

using namespace haff::tests;

namespace {

// The function `expect` types words and a tab, waits until the terminal shows what is expected, and
// empties the line.
constexpr const char* typist = R"SH(
zmodload zsh/zpty
zpty typist zsh -f -i
zpty -w typist "fpath=(\$PWD \$fpath); autoload -Uz compinit; compinit -u -D; print rea''dy"
zpty -r -m typist shown '*ready*'
expect() {
  print -r -- "$1<TAB> shows $2?"
  zpty -w -n typist "$1"$'\t'
  zpty -r -m typist shown "*$2*" || exit 1
  # Nothing that is still on its way may answer the next question.
  zpty -w typist $'\x15'"print do''ne $1"
  zpty -r -m typist shown "*done $1*"
}
)SH";

// Expects all completions that are not empty: the script would wait in vain for nothing to be
// shown.
std::string script() {
  std::string text = typist;
  const auto expect = [&](const std::string& words, std::string shown) {
    std::ranges::replace(shown, ' ', '*');
    text += "expect 'campaign " + words + "' '" + shown + "'\n";
  };
  for (const Completion& each : expected_completions)
    if (*each.given != '\0') expect(each.words, each.given);
  expect("pl", "Draw a question of your own");
  expect("--store grid.json plan gri", "plan grid.json");
  return text + "print good\n";
}

}  // namespace

TEST_CASE("completion: zsh completes commands, options, their values and files") {
  const Folder folder;
  if (shell(folder, "command -v zsh").exit_code != 0) {
    MESSAGE("Skipped: there is no zsh");
    return;
  }
  folder.write("grid.json", "{}");
  folder.write("script", script());
  const Outcome outcome = shell(folder,
                                "\"$campaign\" document zsh > _campaign && "
                                "HOME=$PWD timeout --foreground 60 zsh -f script");
  CAPTURE(outcome.err);
  CHECK_MESSAGE(outcome.out.ends_with("good\n"), outcome.out);
}
