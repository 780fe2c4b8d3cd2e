// SPDX-License-Identifier: GPL-3.0-or-later

// Error against CPU time, log-log, a picture a gas with a panel a quantity: measured scatter of
// group means, the line of slope -1/2, and shifts, which no CPU time removes: of finite size, and
// of any other cause that is seen.
#pragma once

#include <filesystem>

#include "campaign/accuracy/assessment.hpp"
#include "campaign/base/output/output_files.hpp"

namespace haff::campaign {

// SVG and PNG.
OutputFiles draw_cost(const Assessment& assessment, const std::filesystem::path& folder);

}  // namespace haff::campaign
