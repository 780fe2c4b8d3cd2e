// SPDX-License-Identifier: GPL-3.0-or-later

// Where a campaign stands, as JSON: what `campaign status --json` prints. Its keys are described in
// campaign/README.md.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "campaign/report/overview.hpp"

namespace haff::campaign {

nlohmann::ordered_json overview_json(const Overview& overview);

// Parts of it, which `campaign plan --json` has as well: what the box of a job can hold by linear
// theory, null for gases that the theory does not treat; and how far a target is.
nlohmann::ordered_json box_json(const schema::Job& job);
nlohmann::ordered_json target_json(const TargetProgress& progress);

}  // namespace haff::campaign
