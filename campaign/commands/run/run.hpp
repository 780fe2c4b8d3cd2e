// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign run`: rounds of work until the store's targets are met, and what came of them.
#pragma once

#include "campaign/run/coordinator.hpp"

namespace haff::campaign {

// Runs all that is pending, then adds realizations until the store's targets are met; returns an
// ExitCode.
int run(const RunOptions& options);

}  // namespace haff::campaign
