// The log: lines on stderr.
#pragma once

namespace haff::campaign {

void set_up_log(bool verbose);

}  // namespace haff::campaign
