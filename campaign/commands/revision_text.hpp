// SPDX-License-Identifier: GPL-3.0-or-later

// What became, or would become, of jobs that are no longer wanted: for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "schema/store/planning/revision.hpp"

namespace haff::campaign {

// How many jobs have this fate.
std::int64_t count(const schema::Revision& revision, schema::Fate fate);

// A table of all, and sentences that name the jobs that stay or end; empty if there are none.
std::string revision_text(const schema::Revision& revision);

nlohmann::ordered_json revision_json(const schema::Revision& revision);

}  // namespace haff::campaign
