// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/run/worker_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include "campaign/run/process.hpp"

namespace haff::campaign {
namespace {

std::system_error system_error(const char* what) {
  return {errno, std::generic_category(), what};
}

// In the child, between fork and exec: only calls that are safe there.
[[noreturn]] void become_worker(pid_t parent, int reports, const std::vector<char*>& arguments) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it died before the line above
  fcntl(reports, F_SETFD, 0);         // this one stays open
  execv("/proc/self/exe", arguments.data());
  _exit(127);
}

}  // namespace

WorkerProcess::WorkerProcess(const std::filesystem::path& store, const WorkerOptions& options) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw system_error("cannot make a pipe for a worker");
  const auto [read_end, write_end] = ends;

  std::vector<std::string> words{"campaign",
                                 "--store",
                                 store.string(),
                                 "worker",
                                 std::to_string(write_end),
                                 "--threads",
                                 std::to_string(options.share.threads),
                                 "--processors",
                                 std::to_string(options.share.processors)};
  if (options.deadline) {
    words.emplace_back("--until");
    words.push_back(fmt::format("{}", options.deadline->time_since_epoch().count()));
  }
  // Each is one word, --option=value, since the value may begin with a dash.
  if (!options.where.empty()) words.push_back("--where=" + options.where);
  if (!options.order.empty()) words.push_back("--order=" + options.order);
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  const pid_t parent = getpid();
  id_ = fork();
  if (id_ == 0) become_worker(parent, write_end, arguments);
  const int error = errno;
  close(write_end);
  if (id_ < 0) {
    close(read_end);
    errno = error;
    throw system_error("cannot start a worker");
  }
  identity_ = child_process(id_);
  reports_ = read_end;
  fcntl(reports_, F_SETFL, O_NONBLOCK);
}

WorkerProcess::~WorkerProcess() {
  if (id_ > 0) {
    kill_now();
    reap();
  }
  if (reports_ >= 0) close(reports_);
}

WorkerProcess::WorkerProcess(WorkerProcess&& other) noexcept
    : id_(std::exchange(other.id_, 0)),
      identity_(std::move(other.identity_)),
      reports_(std::exchange(other.reports_, -1)),
      killed_(other.killed_),
      unfinished_line_(std::move(other.unfinished_line_)) {}

std::vector<Report> WorkerProcess::take_reports() {
  std::array<char, 4096> buffer{};
  for (ssize_t size = 0; (size = read(reports_, buffer.data(), buffer.size())) > 0;)
    unfinished_line_.append(buffer.data(), static_cast<std::size_t>(size));

  std::vector<Report> reports;
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = unfinished_line_.find('\n', begin)) != std::string::npos;
       begin = end + 1)
    if (const auto report =
            report_from_line(std::string_view(unfinished_line_).substr(begin, end - begin)))
      reports.push_back(*report);
  unfinished_line_.erase(0, begin);
  return reports;
}

void WorkerProcess::signal(int number) const {
  if (id_ > 0) kill(id_, number);
}

void WorkerProcess::kill_now() {
  killed_ = true;
  signal(SIGKILL);
}

bool WorkerProcess::has_ended() const {
  if (id_ <= 0) return false;
  siginfo_t info{};
  if (waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT) != 0)
    return errno == ECHILD;
  return info.si_pid == id_;
}

WorkerProcess::End WorkerProcess::reap() {
  int status = 0;
  pid_t reaped = 0;
  while ((reaped = waitpid(id_, &status, 0)) < 0 && errno == EINTR) {
  }
  id_ = 0;
  if (reaped < 0) return {.exit_code = std::nullopt, .signal = 0, .killed_by_us = killed_};
  if (WIFSIGNALED(status))
    return {.exit_code = 0, .signal = WTERMSIG(status), .killed_by_us = killed_};
  return {.exit_code = WEXITSTATUS(status), .signal = 0, .killed_by_us = killed_};
}

std::string WorkerProcess::End::text() const {
  if (killed_by_us) return "the worker process did not stop in time and was killed";
  if (!exit_code) return "the worker process is gone, and how it ended was not seen";
  if (signal == SIGKILL) return "the worker process was killed (SIGKILL; out of memory?)";
  if (signal != 0)
    return fmt::format("the worker process crashed: signal {} ({})", signal, strsignal(signal));
  return fmt::format("the worker process ended with exit code {}", *exit_code);
}

}  // namespace haff::campaign
