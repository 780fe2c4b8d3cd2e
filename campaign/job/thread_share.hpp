// SPDX-License-Identifier: GPL-3.0-or-later

// How many threads a job gets. Every number gives the same rows, so it may change whenever a job is
// stored.
#pragma once

#include <cstdint>

#include "schema/grid/job.hpp"

namespace haff::campaign {

struct ThreadShare {
  int threads = 0;     // of every worker; 0: the processors are shared out
  int processors = 1;  // of all workers of a run together
};

// The threads of a job while this many jobs are at work or could be: the processors are shared out
// evenly, but no job gets more of them than make it faster.
unsigned threads_for(const schema::Job& job, const ThreadShare& share, std::int64_t jobs);

}  // namespace haff::campaign
