// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/cluster/merge.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace haff::campaign {
namespace {

// The name of the shard; throws if it is none of this store's.
std::string name_of(const schema::Store& store, const schema::Reader& shard) {
  const auto name = shard.shard_name();
  if (!name)
    throw schema::StoreError(shard.path().string() +
                             ": is a store, but not a shard: it was not made by campaign split");
  if (shard.campaign_id() != store.campaign_id())
    throw schema::StoreError(fmt::format("{}: is a shard of another campaign ({}, this one is {})",
                                         shard.path().string(), shard.campaign_id(),
                                         store.campaign_id()));
  return *name;
}

void must_be_sound(const schema::Reader& shard) {
  const schema::Faults faults = shard.faults();
  if (!faults.empty())
    throw schema::Damage(
        fmt::format("{}: is damaged: {}", shard.path().string(),
                    faults.file.empty() ? faults.derived.front() : faults.file.front()));
}

}  // namespace

MergeOutcome merge(schema::Store& store, const std::filesystem::path& path) {
  const schema::Reader shard(path);
  MergeOutcome outcome{.shard = name_of(store, shard)};
  must_be_sound(shard);
  // An equilibration comes home before the jobs that start from it.
  auto rows = shard.jobs();
  std::stable_partition(rows.begin(), rows.end(), [](const schema::JobRow& row) {
    return row.job.kind == schema::Kind::equilibration;
  });
  for (const schema::JobRow& row : rows) {
    shard.checkpoint(row.job_id);  // throws Damage if a bit of the state is wrong
    const schema::Arrival arrival = store.take_over(shard, row.job_id, outcome.shard);
    ++outcome.jobs;
    outcome.advanced += arrival.advanced ? 1 : 0;
    outcome.rows += arrival.rows;
  }
  store.note_merge(outcome.shard);
  return outcome;
}

}  // namespace haff::campaign
