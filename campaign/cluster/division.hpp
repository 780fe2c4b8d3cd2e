// SPDX-License-Identifier: GPL-3.0-or-later

// How the pending jobs of a store are divided among shards of about equal work.
//
// The longest job goes first, each to the shard that then has the least to do (R. L. Graham, SIAM
// J. Appl. Math. 17, 416 (1969): at most 4/3 of the shortest possible makespan). An equilibration
// that several shards need is computed in each of them, since its bits are the same everywhere:
// jobs that share one therefore prefer to stay together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "schema/store/store.hpp"

namespace haff::campaign {

// The longest of the jobs that gain as much from threads as each other.
struct LongJob {
  schema::Job job;
  double cpu_seconds = 0;  // with the equilibration that it waits for [s]
};

// What one shard gets.
struct Share {
  std::vector<std::int64_t> jobs;  // job_id, equilibrations before the jobs that start from them
  std::size_t cooling_jobs = 0;
  double cpu_seconds = 0;  // expected for all that is left of them [s]
  double longest_cpu_seconds =
      0;  // of one cooling job with the equilibration that it waits for [s]
  std::vector<LongJob> long_jobs;  // the longest of each gas

  // The least time for this many workers: the whole load divided evenly, or the longest job on as
  // many threads as help it, whichever is longer. [s]
  double makespan(int workers) const;
};

// CPU time that is left of a job, in proportion to tau. A job without a forecast counts by its
// collisions, at the usual million a second. [s]
double remaining_cpu_seconds(const schema::JobRow& row);

// Divides the pending jobs of `rows` (a store's whole table) into `count` shares, or into fewer if
// there are fewer jobs; no share is empty. An equilibration that is done goes along with the jobs
// that start from it, at no cost. A cooling job whose equilibration is running, failed or lent out
// stays where it is.
std::vector<Share> divide(const std::vector<schema::JobRow>& rows, std::size_t count);

}  // namespace haff::campaign
