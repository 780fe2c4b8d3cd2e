// SPDX-License-Identifier: GPL-3.0-or-later

// A worker as its coordinator sees it: a child process and the pipe through which it reports.
//
// It is this same program, started again (fork and exec) and not merely forked: a SQLite connection
// must not cross a fork, a new process has no locks, threads or half-written buffers of its parent,
// and /proc/self/exe stays this very program even while a newer one is being installed.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "campaign/job/report.hpp"
#include "campaign/run/worker.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {

class WorkerProcess {
 public:
  // Starts it. It dies (SIGKILL) with this process. Throws std::system_error.
  WorkerProcess(const std::filesystem::path& store, const WorkerOptions& options);
  ~WorkerProcess();  // kills and reaps it if it still lives
  WorkerProcess(WorkerProcess&& other) noexcept;
  WorkerProcess& operator=(WorkerProcess&&) = delete;

  const schema::Owner& identity() const { return identity_; }
  int report_descriptor() const { return reports_; }

  // What it has reported since the last call; never waits.
  std::vector<Report> take_reports();

  // Sends a signal, if it lives.
  void signal(int number) const;
  // Sends SIGKILL, and remembers that the signal was ours.
  void kill_now();

  // True once it has ended; it stays in the process table until reap(), so that its number is not
  // given to another process. A child that is not there to be waited for has ended, too.
  bool has_ended() const;

  struct End {
    std::optional<int> exit_code = 0;  // nothing: it ended unseen
    int signal = 0;                    // that killed it, or 0
    bool killed_by_us = false;

    bool is_exit(int code) const { return signal == 0 && exit_code == code; }
    std::string text() const;
  };
  End reap();

 private:
  pid_t id_ = 0;
  schema::Owner identity_;
  int reports_ = -1;
  bool killed_ = false;
  std::string unfinished_line_;
};

}  // namespace haff::campaign
