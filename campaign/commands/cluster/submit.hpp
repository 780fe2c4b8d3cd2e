// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign submit`: the pending jobs of a store, run by Slurm; `campaign task`: one task of it.
#pragma once

#include "campaign/cluster/slurm.hpp"
#include "campaign/cluster/task.hpp"

namespace haff::campaign {

struct SubmitOptions {
  ClusterOptions cluster;
  bool dry_run = false;
  // The number of the round if the job after the round before submits it; 0 if a user does.
  int round = 0;
};

// Splits the store and submits tasks for the shards, and the job that merges them and submits what
// is left. Prints what it did and returns an ExitCode.
int submit(const SubmitOptions& options);

int task(const TaskOptions& options);

}  // namespace haff::campaign
