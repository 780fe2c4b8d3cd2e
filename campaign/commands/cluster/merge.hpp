// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign merge`: what shards have computed comes home.
#pragma once

#include <filesystem>
#include <vector>

namespace haff::campaign {

struct MergeOptions {
  std::filesystem::path store;
  std::vector<std::filesystem::path> shards;
  bool json = false;  // print for programs
};

// Merges each shard and prints the outcome. A shard that is refused is named, with the reason, and
// the others are merged all the same: the ExitCode then says so.
int merge(const MergeOptions& options);

}  // namespace haff::campaign
