// SPDX-License-Identifier: GPL-3.0-or-later

// A team of threads that work on the parts of one job together, again and again.
//
// A window of the parallel event loop takes a few hundred microseconds, so the threads wait for the
// next job by spinning for about as long before they sleep.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace haff::engine {

class Team {
 public:
  Team() = default;
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  // Adds threads until there are so many. The first one is the one that calls run().
  void grow(unsigned size);
  unsigned size() const { return size_; }

  // Calls job(k) for every k = 0 ... size() - 1, each on its own thread, and returns when all of
  // them are done. A job must not throw.
  void run(const std::function<void(unsigned)>& job);
  // Within a job: returns when every thread of the team has come here.
  void wait_for_all();

  // Divides 0 ... count - 1 among the threads: calls job(begin, end) for each part.
  template <class Job>
  void for_parts(std::size_t count, const Job& job) {
    run([&](unsigned thread) { job(part(count, thread), part(count, thread + 1)); });
  }
  // Where the part of a thread begins.
  std::size_t part(std::size_t count, unsigned thread) const { return count * thread / size_; }

 private:
  // `seen`: jobs that were begun before this thread was there.
  void serve(unsigned number, std::uint32_t seen);

  unsigned size_ = 1;
  const std::function<void(unsigned)>* job_ = nullptr;
  std::atomic<std::uint32_t> jobs_ = 0;      // begun so far
  std::atomic<std::uint32_t> busy_ = 0;      // threads that have not finished the present one
  std::atomic<std::uint32_t> arrived_ = 0;   // threads that wait for all
  std::atomic<std::uint32_t> meetings_ = 0;  // of all threads, so far
  std::atomic<bool> stop_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace haff::engine
