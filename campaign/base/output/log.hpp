// SPDX-License-Identifier: GPL-3.0-or-later

// The log: lines on stderr.
#pragma once

namespace haff::campaign {

void set_up_log(bool verbose);

}  // namespace haff::campaign
