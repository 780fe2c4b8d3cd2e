// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/job/thread_share.hpp"

#include <algorithm>

#include "campaign/state/model.hpp"
#include "engine/threads.hpp"

namespace haff::campaign {

unsigned threads_for(const schema::Job& job, const ThreadShare& share, std::int64_t jobs) {
  if (share.threads > 0) return static_cast<unsigned>(share.threads);
  // Counting collisions needs the order of all events: it runs on one thread.
  if (model_of(job).counts_collisions) return 1;
  const std::int64_t each = share.processors / std::max<std::int64_t>(jobs, 1);
  return static_cast<unsigned>(
      std::clamp<std::int64_t>(each, 1, engine::useful_threads(job.particles, job.n, job.d)));
}

}  // namespace haff::campaign
