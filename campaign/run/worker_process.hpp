// A worker as its coordinator sees it: a child process and the pipe it reports through.
//
// It is this same program, started again (fork and exec) rather than forked only: a SQLite
// connection must not cross a fork, a fresh process has no locks, threads or half-written buffers
// of its parent, and /proc/self/exe stays this very program even while a newer one is installed.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "campaign/job/report.hpp"
#include "schema/store.hpp"

namespace haff::campaign {

class WorkerProcess {
 public:
  // Starts it. It dies (SIGKILL) with this process. Throws std::system_error.
  explicit WorkerProcess(const std::filesystem::path& store);
  ~WorkerProcess();  // kills and buries it if it still lives
  WorkerProcess(WorkerProcess&& other) noexcept;
  WorkerProcess& operator=(WorkerProcess&&) = delete;

  const schema::Owner& identity() const { return identity_; }
  int report_descriptor() const { return reports_; }

  // What it has reported since the last call; never waits.
  std::vector<Report> take_reports();

  // Sends a signal, if it lives.
  void signal(int number) const;

  // True once it has ended; it stays in the process table until bury().
  bool has_ended() const;

  struct End {
    int exit_code = 0;
    int signal = 0;  // that killed it, or 0
    std::string text() const;
  };
  End bury();

 private:
  pid_t id_ = 0;
  schema::Owner identity_;
  int reports_ = -1;
  std::string unfinished_line_;
};

}  // namespace haff::campaign
