// Every particle's next event, and which of them comes first.
//
// A ladder: time since the synchronization is cut into windows, a window into `fine_slots`
// slots. An event in a later window is one 4-byte particle number appended to that window's list.
// When a window's turn comes its events go to their slots, and a slot is sorted when reached.
// Nothing is ever deleted: an entry whose particle has been given another time since is dropped
// when met. So the hot part stays in cache however many particles there are.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/bricks.hpp"
#include "engine/memory.hpp"

namespace haff::engine {

// The next thing a particle does: touch its partner or leave its cell.
struct Event {
  double time;                    // the earlier of the two
  double contact_time;            // no contact with anyone known before this
  std::uint32_t partner;          // at contact_time
  std::uint32_t partner_changes;  // the partner's changes when this was computed
  Cell cell;
  Face face;  // to leave through, or `contact`

  static constexpr Face contact = 6;
};
static_assert(sizeof(Event) == 32);

class Calendar {
 public:
  static constexpr std::uint32_t nobody = 0xffffffff;

  explicit Calendar(std::uint32_t particles) : events_(particles) {}

  Event& operator[](std::uint32_t particle) { return events_[particle]; }
  const Event& operator[](std::uint32_t particle) const { return events_[particle]; }

  // Empties the calendar and starts it at time zero, for about `rate` events a unit of time.
  void restart(double rate);

  // Enters the particle at its event's time.
  void schedule(std::uint32_t particle);

  // Takes out the particle whose event is first, or nobody. Where several share the very same
  // time, the one with the smallest rank(particle) is first: order must not depend on how entries
  // happen to lie.
  template <class Rank>
  std::uint32_t next(Rank&& rank);

  // The slot being worked off, and whose entries are in a coming one. Nothing is seen across the
  // end of the window.
  std::uint64_t slot() const { return slot_; }
  auto coming_in(std::uint64_t slot) const {
    const bool known = slot / fine_slots == slot_ / fine_slots;
    return Coming{*this, known ? heads_[slot % fine_slots] : none};
  }

  std::size_t memory() const;

 private:
  static constexpr std::uint32_t fine_slots = 512;
  static constexpr double events_per_slot = 1.5;
  static constexpr std::uint32_t none = 0xffffffff;

  struct Entry {
    double time;
    std::uint32_t particle;
  };
  struct Node {
    double time;
    std::uint32_t particle;
    std::uint32_t next;
  };
  // The particles in a list of nodes.
  struct Coming {
    struct Iterator {
      const Node* nodes;
      std::uint32_t node;

      std::uint32_t operator*() const { return nodes[node].particle; }
      void operator++() { node = nodes[node].next; }
      bool operator!=(const Iterator& other) const { return node != other.node; }
    };
    Iterator begin() const { return {calendar.nodes_.data(), first}; }
    Iterator end() const { return {nullptr, none}; }

    const Calendar& calendar;
    std::uint32_t first;
  };
  // A window's list, in cache lines of 15 particles; `next` is the chunk filled before.
  struct alignas(64) Chunk {
    std::uint32_t particle[15];
    std::uint32_t next;
  };
  struct Window {
    std::uint32_t chunk = none;
    std::uint32_t count = 15;  // in the newest chunk; a full one makes the next append open another
  };

  bool outdated(const Entry& entry) const { return events_[entry.particle].time != entry.time; }
  void append(Window& window, std::uint32_t particle);
  void add_to_slot(std::uint32_t slot, double time, std::uint32_t particle);
  void add_to_active(double time, std::uint32_t particle);
  bool open_next_slot();    // the next slot with entries; false if there is none
  bool open_next_window();  // false if nothing is left
  void extend();            // more windows, for what lay beyond the last
  template <class Rank>
  std::uint32_t settle_tie(Rank&& rank);

  HugeVector<Event> events_;

  double slots_per_time_ = 0;
  std::uint64_t slot_ = 0;            // being worked off, counted from time zero
  std::uint64_t first_window_ = 0;    // number of windows_[0]
  std::vector<Entry> active_;         // its entries, latest first
  std::vector<std::uint32_t> heads_;  // the current window's slots: lists of nodes
  std::vector<Node> nodes_;
  std::uint32_t free_node_ = none;
  std::vector<Window> windows_;
  HugeVector<Chunk> chunks_;
  std::uint32_t free_chunk_ = none;
  std::vector<std::uint32_t> opened_;  // particles of a window that is being opened
  std::vector<std::uint32_t> beyond_;  // events after the last window
};

inline void Calendar::append(Window& window, std::uint32_t particle) {
  if (window.count == 15) {
    std::uint32_t fresh = free_chunk_;
    if (fresh == none) {
      fresh = static_cast<std::uint32_t>(chunks_.size());
      chunks_.emplace_back();
    } else {
      free_chunk_ = chunks_[fresh].next;
    }
    chunks_[fresh].next = window.chunk;
    window.chunk = fresh;
    window.count = 0;
  }
  chunks_[window.chunk].particle[window.count++] = particle;
}

inline void Calendar::add_to_slot(std::uint32_t slot, double time, std::uint32_t particle) {
  std::uint32_t node = free_node_;
  if (node == none) {
    node = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
  } else {
    free_node_ = nodes_[node].next;
  }
  nodes_[node] = {time, particle, heads_[slot]};
  heads_[slot] = node;
}

inline void Calendar::add_to_active(double time, std::uint32_t particle) {
  active_.push_back({time, particle});
  for (std::size_t k = active_.size() - 1; k > 0 && active_[k - 1].time < time; --k)
    std::swap(active_[k - 1], active_[k]);
}

inline void Calendar::schedule(std::uint32_t particle) {
  const double time = events_[particle].time;
  // Far beyond any window, and infinity: kept aside, as the conversion below would overflow.
  const double slots = time * slots_per_time_;
  const auto slot = slots < 0x1p62 ? static_cast<std::uint64_t>(slots) : std::uint64_t{1} << 62;
  if (slot <= slot_) {
    add_to_active(time, particle);
    return;
  }
  const std::uint64_t window = slot / fine_slots;
  if (window == slot_ / fine_slots)
    add_to_slot(static_cast<std::uint32_t>(slot % fine_slots), time, particle);
  else if (window - first_window_ < windows_.size())
    append(windows_[window - first_window_], particle);
  else
    beyond_.push_back(particle);
}

template <class Rank>
std::uint32_t Calendar::next(Rank&& rank) {
  for (;;) {
    if (active_.empty() && !open_next_slot()) return nobody;
    if (active_.size() > 1 && active_.back().time == active_[active_.size() - 2].time)
      return settle_tie(rank);
    const Entry first = active_.back();
    active_.pop_back();
    if (!outdated(first)) return first.particle;
  }
}

template <class Rank>
std::uint32_t Calendar::settle_tie(Rank&& rank) {
  const double time = active_.back().time;
  const auto others = std::find_if(active_.rbegin(), active_.rend(),
                                   [&](const Entry& entry) { return entry.time != time; });
  const auto tied = others.base();
  active_.erase(
      std::remove_if(tied, active_.end(), [&](const Entry& entry) { return outdated(entry); }),
      active_.end());
  if (tied == active_.end()) return next(rank);
  const auto first = std::min_element(tied, active_.end(), [&](const Entry& a, const Entry& b) {
    return rank(a.particle) < rank(b.particle);
  });
  const std::uint32_t particle = first->particle;
  active_.erase(first);
  return particle;
}

}  // namespace haff::engine
