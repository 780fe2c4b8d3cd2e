// The command to type next, as messages show it.
#pragma once

#include <filesystem>
#include <string>

namespace haff::campaign {

inline constexpr const char* default_store = "campaign.db";

// "campaign run", with --store where it is not the default one.
std::string command_text(const std::string& command, const std::filesystem::path& store);

}  // namespace haff::campaign
