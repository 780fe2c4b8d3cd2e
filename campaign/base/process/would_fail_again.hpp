// SPDX-License-Identifier: GPL-3.0-or-later

// Words in the error of a job that would fail again in the same way. No command then advises to try
// it once more.
#pragma once

#include <string_view>

namespace haff::campaign {

inline constexpr std::string_view would_fail_again = "it would fail again in the same way";

}  // namespace haff::campaign
