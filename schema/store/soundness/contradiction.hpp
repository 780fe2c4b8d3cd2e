// SPDX-License-Identifier: GPL-3.0-or-later

// What a job's error says when a row that was computed a second time is not what it was the first
// time. `campaign retry` knows such a job by it.
#pragma once

namespace haff::schema {

inline constexpr const char* came_out_different = "came out different when computed again";

}  // namespace haff::schema
