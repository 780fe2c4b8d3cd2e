// SPDX-License-Identifier: GPL-3.0-or-later

// The command that a run starts at its end (`run --on-finish COMMAND`): a message, a copy, a plot.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace haff::campaign {

// How a run ended. The command finds it in its environment, under the names in capitals.
struct RunOutcome {
  int exit_code = 0;            // CAMPAIGN_EXIT_CODE
  std::int64_t done = 0;        // CAMPAIGN_DONE: jobs that are done, of the whole store
  std::int64_t failed = 0;      // CAMPAIGN_FAILED
  std::int64_t pending = 0;     // CAMPAIGN_PENDING
  std::filesystem::path store;  // CAMPAIGN_STORE: an absolute path
};

// Gives the command to /bin/sh and waits for its end; a signal that asks to stop is passed on. If
// it cannot be started, or fails, a message on stderr says so, and nothing else changes.
void run_on_finish(const std::string& command, const RunOutcome& outcome);

}  // namespace haff::campaign
