// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign backup FILE`: a copy of the store, also while a run is on.
#pragma once

#include <filesystem>

namespace haff::campaign {

int back_up(const std::filesystem::path& store, const std::filesystem::path& to);

}  // namespace haff::campaign
