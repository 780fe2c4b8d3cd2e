// `campaign verify --repair`: what the digests or the checks of jobs find wrong is computed again,
// and put right where it differs.
#pragma once

#include <filesystem>

namespace haff::campaign {

// Says each thing that it does, or all of them as JSON.
int repair(const std::filesystem::path& path, bool json);

}  // namespace haff::campaign
