// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign merge` and `campaign recall`: what shards have computed comes home.
//
// A job that is lent is worked on in its shard alone, and the store that lent it keeps what it had.
// After a merge its rows and its newest state are in both. Merging copies and compares, and takes
// nothing away from a shard.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "schema/store/store.hpp"

namespace haff::campaign {

struct MergeOutcome {
  std::string shard;
  std::int64_t jobs = 0;      // of the shard
  std::int64_t advanced = 0;  // of those, that the shard was ahead of
  std::int64_t rows = 0;      // that were new
};

// Brings home what this shard has, in one transaction for each job: it may be killed, repeated, and
// run at the same time as a run. Holds at most one state in memory. Throws StoreError if the file
// is not a shard of this store's campaign, Damage if the shard is damaged or contradicts what is
// known; what was brought home before stays.
MergeOutcome merge(schema::Store& store, const std::filesystem::path& shard);

}  // namespace haff::campaign
