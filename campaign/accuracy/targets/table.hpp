// SPDX-License-Identifier: GPL-3.0-or-later

// How far the targets are, for people.
#pragma once

#include <string>
#include <vector>

#include "campaign/accuracy/targets/targets.hpp"

namespace haff::campaign {

// Empty if there are none.
std::string targets_table(const std::vector<TargetProgress>& targets);

}  // namespace haff::campaign
