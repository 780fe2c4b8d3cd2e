// SPDX-License-Identifier: GPL-3.0-or-later

// A team of threads that work together on the parts of one job after another.
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
  // Called within a job: returns when every thread of the team has called it.
  void wait_for_all();

  // Divides 0 ... count - 1 among the threads: calls job(begin, end) for each part.
  template <class Job>
  void for_parts(std::size_t count, const Job& job) {
    run([&](unsigned thread) { job(part(count, thread), part(count, thread + 1)); });
  }
  // The index at which the part of a thread begins.
  std::size_t part(std::size_t count, unsigned thread) const { return count * thread / size_; }

 private:
  // `seen`: the number of jobs that were begun before this thread existed.
  void serve(unsigned number, std::uint32_t seen);

  unsigned size_ = 1;
  const std::function<void(unsigned)>* job_ = nullptr;
  std::atomic<std::uint32_t> jobs_ = 0;      // jobs begun so far
  std::atomic<std::uint32_t> busy_ = 0;      // threads that have not finished the present one
  std::atomic<std::uint32_t> arrived_ = 0;   // threads that have called wait_for_all
  std::atomic<std::uint32_t> meetings_ = 0;  // the number of times that all threads have met
  std::atomic<bool> stop_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace haff::engine
