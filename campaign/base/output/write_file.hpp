// SPDX-License-Identifier: GPL-3.0-or-later

// A file that is there and whole, or not there at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace haff::campaign {

// Writes the file, in place of an older one. Throws std::runtime_error that names the file and the
// system's reason if it cannot be written to its end; what was written of it is then removed.
void write_file(const std::filesystem::path& file, std::string_view content);

}  // namespace haff::campaign
