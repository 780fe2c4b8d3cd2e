// SPDX-License-Identifier: GPL-3.0-or-later

// A copy of a store in use, by SQLite's online backup.
#pragma once

#include <cstdint>
#include <filesystem>

#include "schema/database/database.hpp"

namespace haff::schema {

// Reader::back_up. The copy is made under a name of its own and gets the wanted one when it is
// whole and on the disk, so that a backup that was cut off is not taken for a whole one.
std::uintmax_t back_up(Database& database, const std::filesystem::path& to);

}  // namespace haff::schema
