// SPDX-License-Identifier: GPL-3.0-or-later

// The completions that every shell must give.
#pragma once

#include <array>

namespace haff::tests {

// The words after `campaign` at which the user presses tab, and the completions of the last of
// them, separated by blanks; none if the shell has nothing to offer. The folder holds a file
// grid.json.
struct Completion {
  const char* words;
  const char* given;
};

inline constexpr std::array expected_completions{
    Completion{"ret", "retry"},
    Completion{"pl", "plan plot"},
    Completion{"--store grid.json ret", "retry"},
    Completion{"run ret", ""},
    Completion{"run --bud", "--budget"},
    Completion{"run --st", "--store"},
    Completion{"query --format j", "json"},
    Completion{"plan gr", "grid.json"},
    Completion{"--store grid.j", "grid.json"},
    Completion{"run --max-time ", ""},  // a time cannot be guessed
};

}  // namespace haff::tests
