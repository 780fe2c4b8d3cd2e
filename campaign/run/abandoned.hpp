// Jobs whose owner is gone.
#pragma once

#include "schema/store.hpp"

namespace haff::campaign {

// A process on another host cannot be looked at: its lease ends when it has not been renewed for
// this long. Workers renew every few seconds, but a commit may have to wait for others.
inline constexpr double lease_seconds = 300;

// Whether nobody works on the job any more, so that another may take it: its owner on this host is
// dead, or one elsewhere has been silent for too long.
bool is_abandoned(const schema::RunningJob& job);

}  // namespace haff::campaign
