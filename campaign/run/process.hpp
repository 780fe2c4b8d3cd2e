// SPDX-License-Identifier: GPL-3.0-or-later

// What tells a process from every other, and whether it still lives.
//
// A process id alone is not enough: ids are used again, machines restart, and containers number
// their own processes. So the owner of a job is named by its host, the boot of the kernel, the
// namespace in which ids are counted, its id, and the moment when it started.
#pragma once

#include <sys/types.h>

#include "schema/store/store.hpp"

namespace haff::campaign {

schema::Owner this_process();
schema::Owner child_process(pid_t id);  // not yet reaped

// Nothing can be told about another host, nor about another container on this one.
enum class Life { alive, dead, unknown };
Life life_of(const schema::Owner& process);

}  // namespace haff::campaign
