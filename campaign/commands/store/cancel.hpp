// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign cancel`: jobs that are no longer wanted leave the store.
#pragma once

#include <filesystem>
#include <string>

namespace haff::campaign {

struct CancelOptions {
  std::filesystem::path store;
  std::string where;
  bool with_rows = false;  // --delete: computed rows go, too
  bool dry_run = false;    // show what would happen, change nothing
  bool json = false;       // print for programs
};

// Returns an ExitCode: exit_failed if a chosen job is held by a worker or a shard, and stays.
int cancel(const CancelOptions& options);

}  // namespace haff::campaign
