// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/run/abandoned.hpp"

#include "campaign/run/process.hpp"

namespace haff::campaign {

bool is_owner_dead(const schema::RunningJob& job) {
  return life_of(job.owner) == Life::dead;
}

std::int64_t take_back_from_the_dead(schema::Store& store) {
  std::int64_t count = 0;
  for (const schema::RunningJob& job : store.running())
    if (is_owner_dead(job) && store.reclaim(job.lease)) ++count;
  return count;
}

bool LeaseWatch::is_abandoned(const schema::RunningJob& job, Clock::time_point now) {
  switch (life_of(job.owner)) {
    case Life::alive:
      return false;
    case Life::dead:
      return true;
    case Life::unknown:
      break;
  }
  Seen& seen = seen_.try_emplace(job.lease.job_id).first->second;
  if (seen.token != job.lease.token || seen.renewed != job.renewed)
    seen = {.token = job.lease.token, .renewed = job.renewed, .since = now};
  return now - seen.since > lease_time;
}

}  // namespace haff::campaign
