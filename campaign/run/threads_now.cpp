// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/run/threads_now.hpp"

#include <algorithm>
#include <string>

#include "campaign/run/process.hpp"

namespace haff::campaign {

unsigned threads_now(const schema::Job& job, const ThreadShare& share,
                     const schema::Selection& store) {
  // Where the answer is known, the store is not asked.
  const unsigned most = threads_for(job, share, 1);
  if (share.threads > 0 || most == 1) return most;
  const std::string host = this_process().host;
  const std::vector<schema::RunningJob> running = store.running();
  const auto here = std::ranges::count_if(
      running, [&](const schema::RunningJob& other) { return other.owner.host == host; });
  return threads_for(job, share, store.summary().claimable + here);
}

}  // namespace haff::campaign
