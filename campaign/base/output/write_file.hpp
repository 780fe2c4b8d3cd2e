// SPDX-License-Identifier: GPL-3.0-or-later

// Files that are whole, or not there at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace haff::campaign {

// Writes the file, in place of an older one. If it cannot be written to its end, removes what was
// written and throws std::runtime_error, which names the file and the system's reason.
void write_file(const std::filesystem::path& file, std::string_view content);

}  // namespace haff::campaign
