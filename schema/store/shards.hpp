// SPDX-License-Identifier: GPL-3.0-or-later

// Shards: stores that hold some jobs of a campaign, to be run somewhere else.
//
// A shard is a store like any other. It carries the campaign_id of the store that lent it its jobs,
// and a name. Two stores never contradict each other about a job: rows that both have are equal,
// bit for bit, and the store that is behind takes over what the other has beyond it. Merging does
// no more than this, so that shards can be merged in any order and any number of times.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace haff::schema {

// A row of shards, with the numbers of its jobs.
struct Shard {
  std::string name;
  std::filesystem::path path;
  std::string lent;                             // UTC, like the following
  std::optional<std::string> merged, returned;  // returned: empty while it is out
  std::int64_t jobs = 0;                        // that were lent to it
  std::int64_t unfinished = 0;                  // of those, still lent
  double cpu_seconds = 0;                       // spent on them, as far as it was merged [s]
};

// What is lent to a new shard.
struct Loan {
  std::string shard;
  std::filesystem::path path;
  std::vector<std::int64_t> jobs;  // job_id; those that are done go along and are not lent
};

// The result of taking over a job from another store.
struct Arrival {
  std::int64_t rows = 0;  // samples, points of profiles and fields that were new
  bool advanced = false;  // the other store was ahead: its state is now ours
};

}  // namespace haff::schema
