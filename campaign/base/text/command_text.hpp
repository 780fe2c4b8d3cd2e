// SPDX-License-Identifier: GPL-3.0-or-later

// The command to type next, as messages show it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace haff::campaign {

inline constexpr const char* default_store = "campaign.db";

// A word as a POSIX shell needs it: in single quotes where one of its characters means something to
// the shell.
std::string quoted_word(std::string_view word);

// The same for the name of a file, with ./ before one that would be taken for an option.
std::string shell_word(std::string_view file);

// "campaign run", with --store where it is not the default one. The command itself is text for a
// shell: its words are quoted already.
std::string command_text(const std::string& command, const std::filesystem::path& store);

}  // namespace haff::campaign
