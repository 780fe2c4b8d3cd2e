// SPDX-License-Identifier: GPL-3.0-or-later

// `campaign upgrade`: brings a store of an older version of this program forward.
#pragma once

#include <filesystem>

namespace haff::campaign {

int upgrade(const std::filesystem::path& store);

}  // namespace haff::campaign
