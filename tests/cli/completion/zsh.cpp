// SPDX-License-Identifier: GPL-3.0-or-later

// The completions of zsh, typed into a zsh on a terminal.
#include <doctest/doctest.h>

#include <string>

#include "cli/program.hpp"

using namespace haff::tests;

namespace {

// Types words and a tab, waits until the terminal shows what is expected, and empties the
// line.
constexpr const char* script = R"SH(
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
expect 'campaign ret' 'retry'
expect 'campaign pl' 'Draw a question of your own'
expect 'campaign --store grid.json ret' 'retry'
expect 'campaign run --bud' '--budget'
expect 'campaign run --st' '--store'
expect 'campaign query --format j' 'json'
expect 'campaign plan gr' 'grid.json'
expect 'campaign --store gr' 'grid.json'
expect 'campaign --store grid.json plan gri' 'plan grid.json'
print good
)SH";

}  // namespace

TEST_CASE("completion: zsh completes commands, options, their values and files") {
  const Folder folder;
  if (shell(folder, "command -v zsh").exit_code != 0) {
    MESSAGE("Skipped: there is no zsh");
    return;
  }
  folder.write("grid.json", "{}");
  folder.write("script", script);
  // What is not shown is waited for in vain.
  const Outcome outcome = shell(folder,
                                "\"$campaign\" document zsh > _campaign && "
                                "HOME=$PWD timeout --foreground 60 zsh -f script");
  CAPTURE(outcome.err);
  CHECK_MESSAGE(outcome.out.ends_with("good\n"), outcome.out);
}
