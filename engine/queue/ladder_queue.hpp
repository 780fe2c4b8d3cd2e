// SPDX-License-Identifier: GPL-3.0-or-later

// Holds every particle's next event and finds the first of them.
//
// A ladder queue: the time since the last synchronization is cut into windows, and a window into
// slots; a slot holds a dozen events. An event in a later slot of the present window is one 4-byte
// particle number in the list of that slot; an event in a later window is one in the list of that
// window. When a window's turn comes, its events are distributed to its slots. When a slot's turn
// comes, its events are sorted all at once and without a branch, and become due. (Which of two
// events is sooner is as good as random: a heap, or lists of one or two events, would mispredict
// several branches per event.) Nothing is ever deleted: an entry whose particle has been given
// another time since then is dropped when it is met. So the active part stays in cache however many
// particles there are.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/queue/event.hpp"
#include "engine/support/choose.hpp"
#include "engine/support/huge_vector.hpp"

namespace haff::engine {

// The particles that a queue holds: all of them, or those of one thread. An entry of a particle
// that has gone to another thread's queue is dropped when it is met, without a look at its event.
struct AllParticles {
  static constexpr bool holds(const Event&) { return true; }
};
struct OwnParticles {
  bool holds(const Event& event) const { return event.owner == number; }

  std::uint8_t number;
};

template <class Members>
class LadderQueueOf {
 public:
  static constexpr std::uint32_t nothing = 0xffffffff;

  explicit LadderQueueOf(std::uint32_t particles) : LadderQueueOf(nullptr, particles, {}) {
    storage_.resize(particles);
    events_ = storage_.data();
  }
  // A queue for about `particles` of the particles whose events are stored elsewhere.
  LadderQueueOf(Event* events, std::uint32_t particles, Members members)
      : members_(members),
        events_(events),
        particles_(particles),
        window_bits_(particles < small ? bits_if_small : bits_if_large) {}

  Event& operator[](std::uint32_t particle) { return events_[particle]; }
  const Event& operator[](std::uint32_t particle) const { return events_[particle]; }

  // Empties the queue and starts it at time zero, for about `rate` events per unit of time. From
  // then on, it knows the next `foresight` entries in their order.
  void restart(double rate, std::uint32_t foresight = 0);

  // Adds the particle at the time of its event.
  void schedule(std::uint32_t particle);

  // Removes and returns the particle whose event is first; `nothing` if there is none. Among events
  // of exactly the same time, the one with the smallest rank(particle) is first, because the order
  // must not depend on where the entries happen to be stored. (The two partners of a contact share
  // its time; either may come first.)
  template <class Rank>
  std::uint32_t next(Rank&& rank);

  // A hint that the particle's entry is outdated. It is used only if this entry is the next one.
  void forget(std::uint32_t particle) {
    const Entry& entry = due_[head_];
    head_ += static_cast<std::size_t>(
        int{entry.particle == particle} &
        int{entry.time < std::numeric_limits<double>::infinity()});  // not the end itself
  }

  // Puts back the particle that next() has just returned.
  void put_back() { --head_; }

  // The next particle to prefetch for: in the order of the events, each particle once, those whose
  // entries are outdated not at all, and of the two partners of a contact only the first. `nothing`
  // if it is twice `foresight` entries away, or unknown. (To take whatever comes a fixed number of
  // entries later is a third slower for a gas that exceeds the caches: where next() skips entries,
  // their successors are never looked at.)
  std::uint32_t look_ahead() {
    ahead_ = std::max(ahead_, head_);
    while (ahead_ < std::min(end_, head_ + 2 * std::size_t{foresight_})) {
      const Entry& entry = due_[ahead_++];
      ahead_ += choose<std::size_t>(due_[ahead_].time == entry.time, 1, 0);
      if (!outdated(entry)) return entry.particle;
    }
    return nothing;
  }
  // Whether it has come `foresight` entries far.
  bool looks_far() const { return ahead_ >= head_ + foresight_; }

  std::size_t memory() const;

 private:
  using Slot = std::uint64_t;  // counted from time zero
  static constexpr double events_per_slot = 12;
  // For a small gas, a window holds nearly all events, which then go to their slots directly; this
  // saves 3 %. For a large gas, a window holds as many events as stay in cache: with 4096 slots, a
  // gas of 32 000 particles is a tenth slower.
  static constexpr std::uint32_t small = 16000;
  static constexpr unsigned bits_if_small = 10;
  static constexpr unsigned bits_if_large = 6;
  static constexpr std::uint32_t none = 0xffffffff;
  static constexpr Slot no_slot = Slot{1} << 62;

  struct Entry {
    double time;
    std::uint32_t particle;
  };
  static constexpr Entry never_due{std::numeric_limits<double>::infinity(), 0};
  static constexpr std::uint32_t in_chunk = 31;
  // Particle numbers; `next` is the chunk that was filled before this one.
  struct alignas(64) Chunk {
    std::uint32_t particle[in_chunk];
    std::uint32_t next;
  };
  struct List {
    std::uint32_t chunk = none;
    std::uint32_t count = in_chunk;  // in the newest chunk; when full, append() opens another one
  };

  // Times far beyond any window, and infinity, have a slot of their own because the conversion
  // would overflow.
  Slot slot_of(double time) const {
    const double slot = time * slots_per_time_;
    return slot < 0x1p62 ? static_cast<Slot>(static_cast<std::int64_t>(slot)) : no_slot;
  }
  // The number of windows that are created together: enough for some two collisions per particle,
  // so that nearly every event finds its window immediately.
  std::size_t windows_ahead() const {
    return 64 + 4 * std::size_t{particles_} / (static_cast<std::size_t>(events_per_slot) * slots());
  }
  // The number of slots in a window, a power of two.
  Slot slots() const { return Slot{1} << window_bits_; }
  Slot window_of(Slot slot) const { return slot >> window_bits_; }
  Slot in_window(Slot slot) const { return slot & (slots() - 1); }
  // The list of a window. The events of the present window are in the lists of its slots.
  std::size_t list_of(Slot window) const { return slots() + 1 + (window - first_window_); }
  // The time of a particle that is a member; otherwise `absent`.
  double time_of(std::uint32_t particle, double absent) const {
    const Event& event = events_[particle];
    return members_.holds(event) ? event.time : absent;
  }
  bool outdated(const Entry& entry) const {
    const Event& event = events_[entry.particle];
    return !members_.holds(event) || event.time != entry.time;
  }
  bool only_twins() const;
  void append(List& list, std::uint32_t particle);
  void open_chunk(List& list);
  template <class Visit>
  void empty(List& list, const Visit& visit);
  void add_to_due(double time, std::uint32_t particle);
  void add_beyond(std::uint32_t particle);
  void sort_in(std::size_t count);
  void make_room(std::size_t count);
  bool open_next_slot();    // opens the next slot with entries; false if there is none
  bool open_next_window();  // false if no event is left
  void extend();            // creates more windows, for the events beyond the last one
  void prefetch_later();
  void prefetch_chunk(std::uint32_t chunk);
  template <class Visit>
  void visit_all(const std::vector<std::uint32_t>& particles, const Visit& visit) const;
  template <class Rank>
  std::uint32_t settle_tie(Rank&& rank);

  [[no_unique_address]] Members members_;
  HugeVector<Event> storage_;  // empty if the events are stored elsewhere
  Event* events_;              // by particle
  std::uint32_t particles_;    // the approximate number in this queue

  unsigned window_bits_;
  double slots_per_time_ = 0;
  std::uint32_t foresight_ = 0;
  Slot slot_ = 0;          // the last slot that is due, counted from time zero
  Slot first_window_ = 0;  // the first window that has a list
  // Entries in order from head_ to end_, followed by two that are never due.
  std::vector<Entry> due_;
  std::size_t head_ = 0;
  std::size_t end_ = 0;
  std::size_t ahead_ = 0;    // where look_ahead() goes on
  std::vector<List> lists_;  // of the slots, of events that belong to no slot, of the windows
  HugeVector<Chunk> chunks_;
  std::uint32_t free_chunk_ = none;
  std::uint32_t later_chunk_ = none;   // of the next window, prefetched last
  std::vector<std::uint32_t> opened_;  // particles of the window that is being opened
  std::vector<Entry> found_;           // entries of the slot that is being opened
  std::vector<std::uint32_t> beyond_;  // events after the last window
};

template <class Members>
[[gnu::always_inline]] inline void LadderQueueOf<Members>::append(List& list,
                                                                  std::uint32_t particle) {
  if (list.count == in_chunk) [[unlikely]]
    open_chunk(list);
  chunks_[list.chunk].particle[list.count++] = particle;
}

template <class Members>
[[gnu::always_inline]] inline void LadderQueueOf<Members>::schedule(std::uint32_t particle) {
  const double time = events_[particle].time;
  const Slot slot = slot_of(time);
  const Slot window = window_of(slot);
  const std::size_t list = choose(window == window_of(slot_), in_window(slot), list_of(window));
  if (slot <= slot_) [[unlikely]]
    add_to_due(time, particle);
  else if (list < lists_.size()) [[likely]]
    append(lists_[list], particle);
  else
    add_beyond(particle);
}

template <class Members>
template <class Rank>
std::uint32_t LadderQueueOf<Members>::next(Rank&& rank) {
  for (;;) {
    while (head_ + foresight_ >= end_ && open_next_slot()) {
    }
    const Entry& first = due_[head_];
    if (first.time == std::numeric_limits<double>::infinity()) [[unlikely]]
      return nothing;
    if (outdated(first)) [[unlikely]] {
      ++head_;
      continue;
    }
    if (all_of(due_[head_ + 1].time == first.time, !only_twins())) [[unlikely]]
      return settle_tie(rank);
    ++head_;
    return first.particle;
  }
}

// Whether the next two entries are the two partners of one contact, and the third comes later.
template <class Members>
[[gnu::always_inline]] inline bool LadderQueueOf<Members>::only_twins() const {
  const Entry* const due = due_.data() + head_;
  const Event& one = events_[due[0].particle];
  // Of a particle that has gone, no event is looked at; settle_tie() drops its entry.
  const std::uint32_t second =
      members_.holds(events_[due[1].particle]) ? due[1].particle : due[0].particle;
  const Event& other = events_[second];
  const std::uint32_t differ = (one.partner ^ second) | (other.partner ^ due[0].particle) |
                               ((one.face & other.face) ^ Event::contact);
  return all_of(differ == 0, due[2].time != due[0].time);
}

template <class Members>
template <class Rank>
std::uint32_t LadderQueueOf<Members>::settle_tie(Rank&& rank) {
  const auto tied = due_.begin() + static_cast<std::ptrdiff_t>(head_);
  const auto end =
      std::find_if(tied, due_.begin() + static_cast<std::ptrdiff_t>(end_),
                   [time = tied->time](const Entry& entry) { return entry.time != time; });
  const auto first = std::min_element(tied, end, [&](const Entry& a, const Entry& b) {
    if (outdated(a) || outdated(b)) return outdated(a) < outdated(b);
    return rank(a.particle) < rank(b.particle);
  });
  const std::uint32_t particle = first->particle;
  std::rotate(tied, first, first + 1);
  ++head_;
  return particle;
}

extern template class LadderQueueOf<AllParticles>;
extern template class LadderQueueOf<OwnParticles>;

using LadderQueue = LadderQueueOf<AllParticles>;

}  // namespace haff::engine
