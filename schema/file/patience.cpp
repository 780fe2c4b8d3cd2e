// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/file/patience.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

namespace haff::schema {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

// Enough for what is to be written before a process that was asked to stop leaves in order.
constexpr auto in_order = 2s;

// Instructions of SQLite's machine between two looks: a millisecond.
constexpr int look_every = 100'000;

bool allows(void* may_wait) {
  return may_wait == nullptr || reinterpret_cast<bool (*)()>(may_wait)();
}

// When SQLite finds a lock taken, it asks whether to try again; `tries` counts the tries of one
// wait.
int wait_for_lock(void* may_wait, int tries) {
  thread_local Clock::time_point begin;
  if (tries == 0) begin = Clock::now();
  if (!allows(may_wait) || Clock::now() - begin > busy_timeout) return 0;
  std::this_thread::sleep_for(std::min(1ms * (1 + tries), 20ms));
  return 1;
}

int look_around(void* may_wait) {
  thread_local std::optional<Clock::time_point> refused;
  if (allows(may_wait)) {
    refused.reset();
    return 0;
  }
  if (!refused) refused = Clock::now();
  return Clock::now() - *refused > in_order ? 1 : 0;
}

}  // namespace

void be_patient(sqlite3* handle, bool (*may_wait)()) {
  void* asked = reinterpret_cast<void*>(may_wait);
  sqlite3_busy_handler(handle, wait_for_lock, asked);
  sqlite3_progress_handler(handle, look_every, look_around, asked);
}

}  // namespace haff::schema
