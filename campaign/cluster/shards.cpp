// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/cluster/shards.hpp"

#include <set>

#include "campaign/cluster/slurm.hpp"

namespace haff::campaign {
namespace {

namespace fs = std::filesystem;

std::optional<double> fraction_of(const fs::path& shard) try {
  const schema::Summary summary = schema::Reader(shard).summary();
  if (summary.expected_cpu_seconds <= 0) return std::nullopt;
  return summary.reached_cpu_seconds / summary.expected_cpu_seconds;
} catch (const schema::StoreError&) {
  return std::nullopt;
}

}  // namespace

std::vector<ShardStatus> shard_states(const schema::Reader& store) {
  std::vector<ShardStatus> all;
  std::set<fs::path> folders;
  for (schema::Shard& shard : store.shards()) {
    if (!shard.returned) folders.insert(shard.path.parent_path());
    all.push_back({.shard = std::move(shard), .fraction = {}, .where = {}, .slurm = {}});
  }
  std::vector<Round> rounds;
  for (const fs::path& folder : folders)
    for (Round& round : read_records(folder)) rounds.push_back(std::move(round));
  const auto slurm = slurm_states(rounds);
  for (ShardStatus& each : all) {
    if (!each.is_out()) {
      each.where = each.shard.unfinished == 0 ? "home" : "recalled";
      continue;
    }
    each.where = fs::exists(each.shard.path) ? each.shard.path.string()
                                             : each.shard.path.string() + " (is not there)";
    each.fraction = fraction_of(each.shard.path);
    if (const auto found = slurm.find(each.shard.path); found != slurm.end())
      each.slurm = found->second;
  }
  return all;
}

}  // namespace haff::campaign
