// SPDX-License-Identifier: GPL-3.0-or-later

// Where the shards of a store are, and how far each one is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::campaign {

struct ShardStatus {
  schema::Shard shard;
  std::optional<double> fraction;  // of its work, as its file says; nothing if it cannot be read
  std::string where;  // "home", "recalled", "in shards/", or what is wrong with its file
  std::string slurm;  // what squeue says of its task; empty if nothing

  bool is_out() const { return !shard.returned; }
};

// All shards that the store has lent to, in the order of their names.
std::vector<ShardStatus> shard_states(const schema::Reader& store);

}  // namespace haff::campaign
