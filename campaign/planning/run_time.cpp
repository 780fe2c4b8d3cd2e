// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/planning/run_time.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <string>

#include "campaign/job/thread_share.hpp"
#include "engine/threads.hpp"

namespace haff::campaign {
namespace {

using schema::Kind;
using schema::Planned;

double speed_up(const schema::Job& job, unsigned threads) {
  return engine::expected_speed_up(threads, job.particles, job.n, job.d);
}

// A run in large steps, from the end of one job to that of the next.
class ImaginedRun {
 public:
  ImaginedRun(const std::vector<Planned>& jobs, int processors) : share_{.processors = processors} {
    std::map<std::string, std::size_t> equilibrations;
    for (const Planned& planned : jobs)
      if (planned.job.kind == Kind::equilibration)
        equilibrations.emplace(schema::identity(planned.job), equilibrations.size());
    waiting_.resize(equilibrations.size());
    for (const Planned& planned : jobs) {
      if (planned.job.kind == Kind::cooling) {
        const auto start = equilibrations.find(identity(equilibration_of(planned.job)));
        if (start != equilibrations.end()) {
          waiting_[start->second].push_back(&planned);
          continue;
        }
      }
      claimable_.push_back(&planned);
    }
    for (const Planned* planned : claimable_)
      if (planned->job.kind == Kind::equilibration)
        starts_[planned] = equilibrations.at(identity(planned->job));
    std::ranges::make_heap(claimable_, comes_after);
  }

  RunTime work() {
    while (!claimable_.empty() || !running_.empty()) {
      while (!claimable_.empty() && running_.size() < static_cast<std::size_t>(share_.processors))
        begin_next();
      advance();
    }
    return time_;
  }

 private:
  struct Running {
    const Planned* planned;
    double left;   // [s of CPU time on one thread]
    double speed;  // on its present number of threads
  };

  // Equilibrations go first, and then what takes longest.
  static bool comes_after(const Planned* a, const Planned* b) {
    const bool a_first = a->job.kind == Kind::equilibration;
    const bool b_first = b->job.kind == Kind::equilibration;
    if (a_first != b_first) return b_first;
    return a->expected_cpu_seconds.value_or(0) < b->expected_cpu_seconds.value_or(0);
  }

  void begin_next() {
    std::ranges::pop_heap(claimable_, comes_after);
    const Planned* next = claimable_.back();
    claimable_.pop_back();
    running_.push_back({next, next->expected_cpu_seconds.value_or(0), 1});
  }

  // To the end of the job that ends first.
  void advance() {
    const auto jobs = static_cast<std::int64_t>(running_.size() + claimable_.size());
    double step = std::numeric_limits<double>::infinity();
    for (Running& each : running_) {
      const unsigned threads = threads_for(each.planned->job, share_, jobs);
      time_.most_threads = std::max(time_.most_threads, threads);
      each.speed = speed_up(each.planned->job, threads);
      step = std::min(step, each.left / each.speed);
    }
    time_.seconds += step;
    for (Running& each : running_) each.left -= step * each.speed;
    // Rounding leaves the one that ends a little short of it, or beyond.
    const auto ended = [](const Running& each) { return each.left <= 1e-9 * each.speed; };
    for (const Running& each : running_)
      if (const auto start = starts_.find(each.planned); ended(each) && start != starts_.end())
        for (const Planned* planned : waiting_[start->second]) {
          claimable_.push_back(planned);
          std::ranges::push_heap(claimable_, comes_after);
        }
    std::erase_if(running_, ended);
  }

  ThreadShare share_;
  RunTime time_;
  std::vector<const Planned*> claimable_;  // a heap: the next one is its top
  std::vector<Running> running_;
  std::map<const Planned*, std::size_t> starts_;      // numbers of equilibrations
  std::vector<std::vector<const Planned*>> waiting_;  // for each of them
};

}  // namespace

RunTime expected_run_time(const std::vector<Planned>& jobs, int processors) {
  return ImaginedRun(jobs, processors).work();
}

double shortest_time(const schema::Job& job, double cpu_seconds, int processors) {
  return cpu_seconds / speed_up(job, threads_for(job, {.processors = processors}, 1));
}

}  // namespace haff::campaign
