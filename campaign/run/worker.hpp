// A worker: a process that takes one job after another until none is left.
#pragma once

#include <filesystem>

namespace haff::campaign {

// How a worker process ends. Anything else is a crash.
inline constexpr int worker_has_finished = 0;       // no job is left
inline constexpr int worker_was_stopped = 75;       // by a signal; EX_TEMPFAIL of sysexits.h
inline constexpr int worker_cannot_use_store = 74;  // disk full, locked; EX_IOERR

// Works on the store; reports go to this file descriptor. Returns an exit code of the above.
int work(const std::filesystem::path& store, int report_descriptor);

}  // namespace haff::campaign
