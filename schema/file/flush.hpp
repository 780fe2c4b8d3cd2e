// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <filesystem>

namespace haff::schema {

// Waits until what was written to a file, or the names in a folder, are on the disk. False, with
// errno, if the system could not do it.
bool flush_to_disk(const std::filesystem::path& file_or_folder);

}  // namespace haff::schema
