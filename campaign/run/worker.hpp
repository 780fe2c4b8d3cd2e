// SPDX-License-Identifier: GPL-3.0-or-later

// A worker: a process that takes one job after another until none is left.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "campaign/job/thread_share.hpp"
#include "schema/store/planning/choice.hpp"

namespace haff::campaign {

// How a worker process ends. Anything else is a crash.
inline constexpr int worker_has_finished = 0;       // no job is left
inline constexpr int worker_was_stopped = 75;       // by a signal; EX_TEMPFAIL of sysexits.h
inline constexpr int worker_cannot_use_store = 74;  // disk full, locked; EX_IOERR
inline constexpr int worker_has_no_time = 76;  // too little is left for any job to store something

// When the run must end, on the clock that all processes of a host share.
using Deadline = std::chrono::time_point<std::chrono::steady_clock, std::chrono::duration<double>>;

// How far a job must be expected to get before the deadline, if there is one: to its next
// synchronization, or to its end.
std::optional<schema::Fit> what_fits(std::optional<Deadline> deadline);

// The time that the shortest of the jobs that can be claimed needs to store something, with a
// margin for what the expectation leaves out (a busy machine, a clustered gas). [s]
std::optional<double> least_seconds_needed(const schema::Selection& store);

struct WorkerOptions {
  std::optional<Deadline> deadline =
      {};                  // no job is taken of which nothing could be stored by then
  ThreadShare share = {};  // threads for a job
  std::string where = {},
              order = {};  // which jobs, and in which order (schema/store/planning/choice.hpp)
};

// Works on the store; reports go to this file descriptor. Stops in order on the signals of
// base/process/signals.hpp; on SIGUSR1 only after a first checkpoint of its job is stored. Returns
// one of the exit codes above.
int work(const std::filesystem::path& store, int report_descriptor, const WorkerOptions& options);

}  // namespace haff::campaign
