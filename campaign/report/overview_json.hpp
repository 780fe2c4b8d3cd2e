// Where a campaign stands, as JSON: what `campaign status --json` prints. Its keys are described in
// campaign/README.md.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "campaign/report/overview.hpp"

namespace haff::campaign {

nlohmann::ordered_json overview_json(const Overview& overview);

}  // namespace haff::campaign
