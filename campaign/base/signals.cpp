#include "campaign/base/signals.hpp"

#include <atomic>
#include <csignal>
#include <ctime>

namespace haff::campaign {
namespace {

volatile std::sig_atomic_t last = 0;
volatile std::sig_atomic_t count = 0;
std::atomic<std::time_t> first_at = 0;  // on the monotonic clock [s]; 0 before the first
static_assert(std::atomic<std::time_t>::is_always_lock_free, "written by a signal handler");

// Less than the coordinator's patience with a worker, which is killed after that. [s]
constexpr std::time_t wait_after_stop = 2;

std::time_t monotonic_seconds() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec;
}

extern "C" void note(int signal) {
  if (first_at == 0) first_at = monotonic_seconds();
  last = signal;
  count = count + 1;
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
  return count == 0 || (count == 1 && monotonic_seconds() - first_at <= wait_after_stop);
}

}  // namespace haff::campaign
