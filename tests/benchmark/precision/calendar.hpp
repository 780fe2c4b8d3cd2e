// Every particle's next event, and which of them comes first.
//
// A ladder: time since the synchronization is cut into windows, a window into slots, a slot holds a
// dozen events. An event in a later slot is one 4-byte particle number appended to that slot's
// list, one in a later window to that window's. When a window's turn comes its events go to its
// slots; when a slot's turn comes its events are sorted, all at once and without a branch (what is
// sooner is as good as random: a heap, or lists of one or two, are predicted wrong several times an
// event), and are due. Nothing is ever deleted: an entry whose particle has been given another time
// since is dropped when met. So the hot part stays in cache however many particles there are.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/choose.hpp"
#include "engine/memory.hpp"
#include "tests/benchmark/precision/bricks.hpp"

namespace haff::single {

// The next thing a particle does: touch its partner or leave its cell.
struct Event {
  float time;                     // the earlier of the two
  float contact_time;             // no contact with anyone known before this
  std::uint32_t partner;          // at contact_time
  std::uint32_t partner_changes;  // the partner's changes when this was computed
  Cell cell;
  Face face;  // to leave through, or `contact`

  static constexpr Face contact = 6;
};
static_assert(sizeof(Event) == 24);
using engine::all_of;
using engine::choose;

class Calendar {
 public:
  static constexpr std::uint32_t nobody = 0xffffffff;

  explicit Calendar(std::uint32_t particles)
      : events_(particles), window_bits_(particles < small ? bits_if_small : bits_if_large) {}

  Event& operator[](std::uint32_t particle) { return events_[particle]; }
  const Event& operator[](std::uint32_t particle) const { return events_[particle]; }

  // Empties the calendar and starts it at time zero, for about `rate` events a unit of time. From
  // then on `foresight` events are known to coming().
  void restart(double rate, std::uint32_t foresight = 0);

  // Enters the particle at its event's time.
  void schedule(std::uint32_t particle);

  // Takes out the particle whose event is first, or nobody. At the very same time (at a million
  // particles every second event) it is whoever lies first: that depends on the state alone.
  std::uint32_t next();

  // The particle's next entry is void. Only a hint, and heeded only if it is the very next.
  void forget(std::uint32_t particle) {
    const Entry& entry = due_[head_];
    head_ += static_cast<std::size_t>(
        int{entry.particle == particle} &
        int{entry.time < std::numeric_limits<float>::infinity()});  // not the end itself
  }

  // Whose event comes so many places later, as far as is known now; at the end, any particle.
  std::uint32_t coming(std::uint32_t places) const {
    return due_[std::min<std::size_t>(head_ + places, end_)].particle;
  }

  std::size_t memory() const;

 private:
  using Slot = std::uint64_t;  // counted from time zero
  static constexpr double events_per_slot = 12;
  // A window holds nearly all events of a small gas, which then go to their slots at once: 3 %. Of
  // a large one it holds as many as stay in cache: with 4096 slots 32 000 are a tenth slower.
  static constexpr std::uint32_t small = 16000;
  static constexpr unsigned bits_if_small = 10;
  static constexpr unsigned bits_if_large = 6;
  static constexpr std::uint32_t none = 0xffffffff;
  static constexpr Slot no_slot = Slot{1} << 62;

  struct Entry {
    float time;
    std::uint32_t particle;
  };
  static constexpr Entry never_due{std::numeric_limits<float>::infinity(), 0};
  static constexpr std::uint32_t in_chunk = 31;
  // Particles; `next` is the chunk filled before.
  struct alignas(64) Chunk {
    std::uint32_t particle[in_chunk];
    std::uint32_t next;
  };
  struct List {
    std::uint32_t chunk = none;
    std::uint32_t count = in_chunk;  // in the newest; once it is full the next append opens another
  };

  // Far beyond any window, and infinity: kept aside, as the conversion would overflow.
  Slot slot_of(float time) const {
    const double slot = time * slots_per_time_;
    return slot < 0x1p62 ? static_cast<Slot>(static_cast<std::int64_t>(slot)) : no_slot;
  }
  // Windows made at a time: enough for some two collisions per particle, so that nearly every event
  // finds its window at once.
  std::size_t windows_ahead() const {
    return 64 + 4 * events_.size() / (static_cast<std::size_t>(events_per_slot) * slots());
  }
  // A window has a power of two of slots.
  Slot slots() const { return Slot{1} << window_bits_; }
  Slot window_of(Slot slot) const { return slot >> window_bits_; }
  Slot in_window(Slot slot) const { return slot & (slots() - 1); }
  // A window's list; who is in the current window is in its slots' lists.
  std::size_t list_of(Slot window) const { return slots() + 1 + (window - first_window_); }
  bool outdated(const Entry& entry) const { return events_[entry.particle].time != entry.time; }
  void append(List& list, std::uint32_t particle);
  void open_chunk(List& list);
  template <class Visit>
  void empty(List& list, const Visit& visit);
  void add_to_due(float time, std::uint32_t particle);
  void add_beyond(std::uint32_t particle);
  void sort_in(std::size_t count);
  void make_room(std::size_t count);
  bool open_next_slot();    // the next slot with entries; false if there is none
  bool open_next_window();  // false if nothing is left
  void extend();            // more windows, for what lay beyond the last

  HugeVector<Event> events_;

  unsigned window_bits_;
  double slots_per_time_ = 0;
  std::uint32_t foresight_ = 0;
  Slot slot_ = 0;          // the last one that is due, counted from time zero
  Slot first_window_ = 0;  // the first one that has a list
  // In order from head_ to end_; there follow two that are never due.
  std::vector<Entry> due_;
  std::size_t head_ = 0;
  std::size_t end_ = 0;
  std::vector<List> lists_;  // of slots, one more for what belongs to none, and of windows
  HugeVector<Chunk> chunks_;
  std::uint32_t free_chunk_ = none;
  std::vector<std::uint32_t> opened_;  // particles of a window that is being opened
  std::vector<Entry> found_;           // entries of a slot that is being opened
  std::vector<std::uint32_t> beyond_;  // events after the last window
};

[[gnu::always_inline]] inline void Calendar::append(List& list, std::uint32_t particle) {
  if (list.count == in_chunk) [[unlikely]]
    open_chunk(list);
  chunks_[list.chunk].particle[list.count++] = particle;
}

[[gnu::always_inline]] inline void Calendar::schedule(std::uint32_t particle) {
  const float time = events_[particle].time;
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

[[gnu::always_inline]] inline std::uint32_t Calendar::next() {
  for (;;) {
    while (head_ + foresight_ >= end_ && open_next_slot()) {
    }
    const Entry& first = due_[head_];
    if (first.time == std::numeric_limits<float>::infinity()) [[unlikely]]
      return nobody;
    ++head_;
    if (outdated(first)) [[unlikely]]
      continue;
    return first.particle;
  }
}

}  // namespace haff::single
