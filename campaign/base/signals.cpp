#include "campaign/base/signals.hpp"

#include <csignal>

namespace haff::campaign {
namespace {

volatile std::sig_atomic_t last = 0;
volatile std::sig_atomic_t count = 0;

extern "C" void note(int signal) {
  last = signal;
  count = count + 1;
}

}  // namespace

void note_stop_signals() {
  struct sigaction action {};
  action.sa_handler = note;  // without SA_RESTART: a waiting poll() returns at once
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

int stop_signal() {
  return last;
}

int stop_signals() {
  return count;
}

}  // namespace haff::campaign
