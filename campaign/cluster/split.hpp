// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign split`: the pending jobs of a store, lent to shards that can be run on other machines.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "campaign/cluster/division.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

// A shard that is written, or would be.
struct WrittenShard {
  std::string name;            // shard-001
  std::filesystem::path path;  // <folder>/shard-001.db
  Share share;
};

// The shards that split() would write, with names that go on from those that the store has lent to
// before. Throws StoreError if a file of such a name is there.
std::vector<WrittenShard> planned_shards(const schema::Reader& store, std::size_t count,
                                         const std::filesystem::path& folder);

// Lends all pending jobs of the store to at most `count` new shards in this folder, which is made
// if it is not there. Names go on from the shards that the store has lent to before. If a shard
// cannot be written, what was lent is taken back, the unfinished file is removed, and the exception
// passes on; if the process is killed meanwhile, `campaign recall` takes back what was lent.
std::vector<WrittenShard> split(schema::Store& store, std::size_t count,
                                const std::filesystem::path& folder);

}  // namespace haff::campaign
