// SPDX-License-Identifier: GPL-3.0-or-later

// Rounds of `campaign submit`, from sbatch to the day when their shards are home.
//
// Each step leaves a record before it does what cannot be undone. Wherever a command, or the job
// that merges, is cut off, the next `campaign submit` therefore knows what is out and goes on from
// there: shards that no task will work on any more come home, and tasks that have lost the job that
// merges them get another one.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "campaign/cluster/slurm.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

// One `campaign submit` at a time uses a folder of shards. Throws std::runtime_error if another
// does.
class SubmissionLock {
 public:
  explicit SubmissionLock(const std::filesystem::path& folder);
  ~SubmissionLock();
  SubmissionLock(const SubmissionLock&) = delete;
  SubmissionLock& operator=(const SubmissionLock&) = delete;

 private:
  int file_;
};

// A round of which shards are still out.
struct OpenRound {
  Round round;
  std::vector<schema::Shard> shards;
  bool has_tasks = false;  // in Slurm's queue
  bool has_merge = false;  // the same, other than the job that asks
};

// All of them, the oldest first. `ended` is the round whose tasks have all ended, if this process
// is the job after it; Slurm is only asked about the others.
std::vector<OpenRound> open_rounds(const schema::Reader& store, const std::filesystem::path& folder,
                                   std::optional<int> ended);

// Writes the scripts and gives the tasks to sbatch, then the job after them. If one of the two is
// refused for so long, nothing stays in the queue, and std::runtime_error is thrown.
void enqueue(const ClusterOptions& options, Round& round, std::chrono::seconds patience);

// The second part alone, for tasks that have lost that job.
void enqueue_merge(const ClusterOptions& options, Round& round, std::chrono::seconds patience);

}  // namespace haff::campaign
