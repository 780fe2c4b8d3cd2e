// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign retry`: failed jobs get another chance, damaged checkpoints are thrown away.
#pragma once

#include <filesystem>

namespace haff::campaign {

// Reopens what can be reopened and says so, for people or as JSON; returns an ExitCode.
int retry(const std::filesystem::path& store, bool json);

}  // namespace haff::campaign
