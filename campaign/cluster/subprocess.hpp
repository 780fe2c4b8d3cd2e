// SPDX-License-Identifier: GPL-3.0-or-later

// Another program, which gets no input and whose output is read.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace haff::campaign {

struct ProgramOutput {
  int exit_code = 0;  // 128 + signal if a signal ended it
  std::string out;    // what it printed to stdout; stderr is that of this process
};

// Runs the program that the first word names, found as a shell finds it, and waits for its end.
// Nothing if there is no such program. Throws std::system_error if it cannot be started.
std::optional<ProgramOutput> ask(const std::vector<std::string>& words);

// Where a shell would find the program, if it would.
std::optional<std::filesystem::path> find_program(const std::string& name);

}  // namespace haff::campaign
