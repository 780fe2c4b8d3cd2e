// SPDX-License-Identifier: GPL-3.0-or-later

// How long a run takes on one machine: its workers take the jobs in the order in which a run does,
// the longest first, and share out the processors as a run does (job/thread_share.hpp).
#pragma once

#include <vector>

#include "schema/store/store.hpp"

namespace haff::campaign {

struct RunTime {
  double seconds = 0;         // by the clock on the wall
  unsigned most_threads = 1;  // that a job gets at any time
};

// Of these jobs, all of them from the start, with one worker for each processor. A job without a
// forecast takes no time.
RunTime expected_run_time(const std::vector<schema::Planned>& jobs, int processors);

// The shortest time in which one job with this CPU time can be done on so many processors. [s]
double shortest_time(const schema::Job& job, double cpu_seconds, int processors);

}  // namespace haff::campaign
