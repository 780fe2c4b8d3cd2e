// SPDX-License-Identifier: GPL-3.0-or-later

// The share of threads that a job has now (job/thread_share.hpp).
#pragma once

#include "campaign/job/thread_share.hpp"
#include "schema/store/planning/choice.hpp"

namespace haff::campaign {

// The processors are shared among the jobs that are at work on this host and the chosen ones that
// could be claimed.
unsigned threads_now(const schema::Job& job, const ThreadShare& share,
                     const schema::Selection& store);

}  // namespace haff::campaign
