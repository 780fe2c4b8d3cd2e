// `campaign verify`: whether the store is sound, from SQLite's pages to the physics in it.
#pragma once

#include <filesystem>

namespace haff::campaign {

// Prints what is wrong, if anything, and what helps, or the same as JSON; returns an ExitCode.
int verify(const std::filesystem::path& store, bool json);

}  // namespace haff::campaign
