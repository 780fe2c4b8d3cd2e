// SPDX-License-Identifier: GPL-3.0-or-later

// Durations as people write them: 90, 90s, 45m, 1h30m, 2d.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace haff::campaign {

// Seconds; a number without a unit is seconds. Nothing if the text is no positive duration.
std::optional<double> seconds_from_text(std::string_view text);

// Two units at most: "1d 4h", "2h 05m", "3m 20s", "4.2 s", "0.03 s".
std::string duration_text(double seconds);

}  // namespace haff::campaign
