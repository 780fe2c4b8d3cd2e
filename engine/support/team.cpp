// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/support/team.hpp"

namespace haff::engine {
namespace {

// Some 100 microseconds of spinning, in the last part of which the thread yields the processor to
// others.
constexpr int spins = 4000;
constexpr int yields = 50;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#else
  std::this_thread::yield();
#endif
}

// Returns when the value is no longer `old`.
void wait_while(const std::atomic<std::uint32_t>& value, std::uint32_t old) {
  for (int k = 0; k < spins; ++k) {
    if (value.load(std::memory_order_acquire) != old) return;
    pause();
  }
  for (int k = 0; k < yields; ++k) {
    if (value.load(std::memory_order_acquire) != old) return;
    std::this_thread::yield();
  }
  value.wait(old, std::memory_order_acquire);
}

}  // namespace

void Team::grow(unsigned size) {
  const std::uint32_t jobs = jobs_;
  for (; size_ < size; ++size_) threads_.emplace_back([this, k = size_, jobs] { serve(k, jobs); });
}

Team::~Team() {
  stop_ = true;
  ++jobs_;
  jobs_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Team::run(const std::function<void(unsigned)>& job) {
  if (size_ == 1) {
    job(0);
    return;
  }
  job_ = &job;
  busy_.store(size_ - 1, std::memory_order_relaxed);
  jobs_.fetch_add(1, std::memory_order_release);
  jobs_.notify_all();
  job(0);
  for (;;) {
    const std::uint32_t busy = busy_.load(std::memory_order_acquire);
    if (busy == 0) return;
    wait_while(busy_, busy);
  }
}

void Team::wait_for_all() {
  if (size_ == 1) return;
  const std::uint32_t meeting = meetings_.load(std::memory_order_acquire);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == size_) {
    arrived_.store(0, std::memory_order_relaxed);
    meetings_.fetch_add(1, std::memory_order_release);
    meetings_.notify_all();
    return;
  }
  while (meetings_.load(std::memory_order_acquire) == meeting) wait_while(meetings_, meeting);
}

void Team::serve(unsigned number, std::uint32_t seen) {
  for (;; ++seen) {
    wait_while(jobs_, seen);
    if (stop_) return;
    (*job_)(number);
    if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_all();
  }
}

}  // namespace haff::engine
