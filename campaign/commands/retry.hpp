// `campaign retry`: failed jobs get another chance, damaged checkpoints are thrown away.
#pragma once

#include <filesystem>

namespace haff::campaign {

// Reopens what can be reopened and says so; returns an ExitCode.
int retry(const std::filesystem::path& store);

}  // namespace haff::campaign
