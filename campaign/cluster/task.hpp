// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign task`: one shard, worked on by one task of a batch system.
//
// The shard in the user's folder may lie on a network file system, where SQLite's locks and shared
// memory cannot be trusted. So it is never opened for writing there: the task copies it to a disk
// of its node, runs it there like any store, and puts it back by copying and renaming, from time to
// time and at the end. The user's folder always holds one whole shard; when a node dies, the work
// since the shard was last put back is lost.
#pragma once

#include <filesystem>
#include <optional>

namespace haff::campaign {

struct TaskOptions {
  std::filesystem::path shard;
  int workers = 1;
  std::optional<double> max_seconds;  // of the wall clock, for computing
  double put_back_every = 600;        // [s]
};

// Works on the shard until nothing is left, time is over or a signal comes (signals.hpp). Returns
// the ExitCode of the run. Throws std::runtime_error if the shard cannot be copied either way.
int work_on_shard(const TaskOptions& options);

}  // namespace haff::campaign
