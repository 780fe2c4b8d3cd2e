// SPDX-License-Identifier: GPL-3.0-or-later

// CPU time that processes have spent. [s]
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <ctime>

namespace haff::campaign {

inline double cpu_seconds(clockid_t clock = CLOCK_PROCESS_CPUTIME_ID) {
  timespec spent{};
  if (clock_gettime(clock, &spent) != 0) return 0;
  return static_cast<double>(spent.tv_sec) + 1e-9 * static_cast<double>(spent.tv_nsec);
}

// That of another process as long as it is there; 0 if it is not.
inline double cpu_seconds_of(pid_t process) {
  clockid_t clock{};
  return clock_getcpuclockid(process, &clock) == 0 ? cpu_seconds(clock) : 0;
}

// That of all child processes that have ended and were waited for.
inline double cpu_seconds_of_ended_children() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace haff::campaign
