// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign split`: pending jobs, lent to shards for other machines.
#pragma once

#include <cstddef>
#include <filesystem>

namespace haff::campaign {

struct SplitOptions {
  std::filesystem::path store;
  std::size_t into = 0;
  std::filesystem::path out = "shards";
  int workers = 1;       // of each shard, for the expected time
  bool dry_run = false;  // print the table only
  bool json = false;     // print for programs
};

// Writes the shards, prints the load of each, and returns an ExitCode.
int split(const SplitOptions& options);

}  // namespace haff::campaign
