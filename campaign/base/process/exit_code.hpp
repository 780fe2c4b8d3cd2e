// SPDX-License-Identifier: GPL-3.0-or-later

// How the program ends. The same numbers for every command.
#pragma once

namespace haff::campaign {

enum ExitCode : int {
  exit_complete = 0,
  exit_failed = 1,     // a job failed, a target cannot be met, the store is damaged or not writable
  exit_bad_input = 2,  // grid, command line or SQL
  exit_out_of_time = 3,   // stopped by --max-time or --budget with work left
  exit_signal_base = 128  // plus the signal that interrupted it
};

}  // namespace haff::campaign
