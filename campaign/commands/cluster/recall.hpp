// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign recall`: jobs that a shard will not finish are pending again.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace haff::campaign {

struct RecallOptions {
  std::filesystem::path store;
  std::vector<std::string> shards;  // names, or paths of their files
  bool json = false;                // print for programs
};

// Merges what is left of each shard, if its file is there, and makes its unfinished jobs pending.
// Returns an ExitCode.
int recall(const RecallOptions& options);

}  // namespace haff::campaign
