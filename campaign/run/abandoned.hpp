// SPDX-License-Identifier: GPL-3.0-or-later

// Jobs whose owner is gone.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

#include "schema/store/store.hpp"

namespace haff::campaign {

// A process on another host, or in another container, cannot be seen: its lease ends when it has
// not been renewed for this long. Workers renew their leases every few seconds, but a commit may
// have to wait for others.
inline constexpr std::chrono::seconds lease_time{300};

// Whether the owner of a job was on this host and is dead.
bool is_owner_dead(const schema::RunningJob& job);

// Takes back the jobs whose owners were on this host and are dead. Returns how many.
std::int64_t take_back_from_the_dead(schema::Store& store);

// Judges leases by watching them. The times that the store holds come from the clocks of several
// hosts, which may differ and jump, so only the watcher's own monotonic clock counts: a lease has
// ended when it was seen unchanged for lease_time.
class LeaseWatch {
 public:
  using Clock = std::chrono::steady_clock;

  // Whether no process works on the job any more, so that another worker may take it. To be asked
  // again and again for all running jobs.
  bool is_abandoned(const schema::RunningJob& job, Clock::time_point now = Clock::now());

 private:
  struct Seen {
    std::int64_t token = 0;
    std::string renewed;
    Clock::time_point since;
  };
  std::map<std::int64_t, Seen> seen_;  // by job
};

}  // namespace haff::campaign
