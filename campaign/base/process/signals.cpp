// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/base/process/signals.hpp"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>

namespace haff::campaign {
namespace {

volatile std::sig_atomic_t last = 0;
volatile std::sig_atomic_t count = 0;
std::atomic<std::int64_t> first_at = 0;  // on the monotonic clock [ms]; 0 before the first
static_assert(std::atomic<std::int64_t>::is_always_lock_free, "written by a signal handler");

// Less than the coordinator's patience with a worker, which is killed after that. [ms]
constexpr std::int64_t wait_after_stop = 2000;

// A batch system signals every process of a task, and each passes it on to its children: a signal
// that comes so soon after the first one is the same request. [ms]
constexpr std::int64_t same_wish = 700;

std::int64_t monotonic_milliseconds() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * 1000 + time.tv_nsec / 1'000'000;
}

extern "C" void note(int signal) {
  const std::int64_t now = monotonic_milliseconds();
  if (first_at == 0) first_at = now;
  last = signal;
  if (count == 0 || now - first_at > same_wish) count = count + 1;
}

bool is_ignored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void note_stop_signals() {
  struct sigaction action {};
  action.sa_handler = note;  // without SA_RESTART: a waiting poll() returns at once
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU})
    if (signal != SIGHUP || !is_ignored(SIGHUP)) sigaction(signal, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGCHLD, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

int stop_signal() {
  return last;
}

int stop_signals() {
  return count;
}

bool may_wait_for_locks() {
  return count == 0 || (count == 1 && monotonic_milliseconds() - first_at <= wait_after_stop);
}

}  // namespace haff::campaign
