// SPDX-License-Identifier: GPL-3.0-or-later

// The events of one window that a thread takes over at once: those that wait at a border, or all of
// them. Few more are added on the way, because few of the following events are in the same window.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/queue/event.hpp"
#include "engine/queue/ladder_queue.hpp"
#include "engine/queue/upcoming.hpp"

namespace haff::engine {

class WindowQueue {
 public:
  struct Entry {
    double time;
    std::uint32_t particle;
  };
  static bool sooner(const Entry& a, const Entry& b) { return a.time < b.time; }

  explicit WindowQueue(const Event* events) : events_(events) {}

  void clear() {
    due_.clear();
    added_.clear();
    head_ = ahead_ = 0;
  }
  // Takes entries in any order; sort() has to follow.
  void take(std::uint32_t particle) { due_.push_back({events_[particle].time, particle}); }
  void sort() { std::sort(due_.begin(), due_.end(), sooner); }
  // Takes entries in the order of time, in addition to others that were taken in this way.
  void merge(const std::vector<Entry>& entries) {
    const auto middle = static_cast<std::ptrdiff_t>(due_.size());
    due_.insert(due_.end(), entries.begin(), entries.end());
    std::inplace_merge(due_.begin(), due_.begin() + middle, due_.end(), sooner);
  }

  void add(std::uint32_t particle) {
    added_.push_back({events_[particle].time, particle});
    std::push_heap(added_.begin(), added_.end(), later);
  }

  // Removes and returns the particle whose event is first, by (time, rank); LadderQueue's `nothing`
  // if there is none. Entries whose particle has been given another time are dropped.
  template <class Rank>
  std::uint32_t next(const Rank& rank) {
    while (head_ < due_.size() && outdated(due_[head_])) ++head_;
    while (!added_.empty() && outdated(added_.front())) pop_added();
    const double time = std::min(head_ < due_.size() ? due_[head_].time : never_due,
                                 added_.empty() ? never_due : added_.front().time);
    if (time == never_due) return nothing;
    // Collects all entries of this time, to find the one with the smallest rank.
    tied_.clear();
    for (; head_ < due_.size() && due_[head_].time == time; ++head_)
      if (!outdated(due_[head_])) tied_.push_back(due_[head_].particle);
    for (; !added_.empty() && added_.front().time == time; pop_added())
      if (!outdated(added_.front())) tied_.push_back(added_.front().particle);
    auto least = tied_.begin();
    if (tied_.size() > 1) {
      least = std::min_element(tied_.begin(), tied_.end(),
                               [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
      for (auto other = tied_.begin(); other != tied_.end(); ++other)
        if (*other != *least) add(*other);
    }
    return *least;
  }

  // As in LadderQueue, among the entries that were taken at once.
  std::uint32_t look_ahead() {
    ahead_ = std::max(ahead_, head_);
    while (ahead_ < std::min(due_.size(), head_ + 2 * foresight)) {
      const Entry& entry = due_[ahead_++];
      const std::size_t later = std::min<std::size_t>(ahead_ + foresight, due_.size() - 1);
      __builtin_prefetch(events_ + due_[later].particle, 1, 2);
      if (ahead_ < due_.size() && due_[ahead_].time == entry.time) ++ahead_;
      if (!outdated(entry)) return entry.particle;
    }
    return nothing;
  }
  bool looks_far() const { return ahead_ >= head_ + foresight; }
  // The particle whose event is the first of these entries; `nothing` if there is none.
  std::uint32_t first_taken() const { return due_.empty() ? nothing : due_.front().particle; }

  // Visits all particles that are still waiting.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t k = head_; k < due_.size(); ++k)
      if (!outdated(due_[k])) visit(due_[k].particle);
    for (const Entry& entry : added_)
      if (!outdated(entry)) visit(entry.particle);
  }

  static constexpr std::uint32_t nothing = LadderQueue::nothing;

 private:
  static constexpr double never_due = std::numeric_limits<double>::infinity();
  static bool later(const Entry& a, const Entry& b) { return a.time > b.time; }
  bool outdated(const Entry& entry) const { return events_[entry.particle].time != entry.time; }
  void pop_added() {
    std::pop_heap(added_.begin(), added_.end(), later);
    added_.pop_back();
  }

  const Event* events_;
  std::vector<Entry> due_;  // in order from head_ on
  std::size_t head_ = 0;
  std::size_t ahead_ = 0;     // where look_ahead() goes on
  std::vector<Entry> added_;  // a heap
  std::vector<std::uint32_t> tied_;
};

}  // namespace haff::engine
