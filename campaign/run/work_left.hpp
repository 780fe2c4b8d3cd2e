// SPDX-License-Identifier: GPL-3.0-or-later

// Whether a run still has something to do, or to wait for.
#pragma once

#include "schema/store/store.hpp"

namespace haff::campaign {

// Jobs of other runs count too: jobs may wait for them, and they may come back unfinished.
inline bool may_have_work(const schema::Summary& summary) {
  return summary.claimable + summary.waiting + summary.jobs.at(schema::Status::running) > 0;
}

}  // namespace haff::campaign
