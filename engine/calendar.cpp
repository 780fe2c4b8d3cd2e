#include "engine/calendar.hpp"

#include <algorithm>
#include <cmath>

namespace haff::engine {
namespace {

// Windows made at a time: enough for some two collisions per particle, so that nearly every event
// finds its window at once. A window costs 8 bytes.
std::size_t windows_ahead(std::size_t particles) {
  return std::max<std::size_t>(1024, particles / 256);
}

}  // namespace

void Calendar::restart(double rate) {
  slots_per_time_ = rate / events_per_slot;
  slot_ = 0;
  first_window_ = 0;
  active_.clear();
  heads_.assign(fine_slots, none);
  nodes_.clear();
  free_node_ = none;
  windows_.assign(windows_ahead(events_.size()), {});
  chunks_.clear();
  free_chunk_ = none;
  beyond_.clear();
}

bool Calendar::open_next_slot() {
  for (;;) {
    ++slot_;
    const auto local = static_cast<std::uint32_t>(slot_ % fine_slots);
    if (local == 0 && !open_next_window()) return false;
    std::uint32_t node = heads_[local];
    if (node == none) continue;
    heads_[local] = none;
    while (node != none) {
      const Node taken = nodes_[node];
      nodes_[node].next = free_node_;
      free_node_ = node;
      if (const Entry entry{taken.time, taken.particle}; !outdated(entry))
        add_to_active(entry.time, entry.particle);
      node = taken.next;
    }
    if (!active_.empty()) return true;
  }
}

bool Calendar::open_next_window() {
  // slot_ is the first of the new window. Skip windows that are empty.
  while (true) {
    const std::uint64_t window = slot_ / fine_slots;
    if (window - first_window_ >= windows_.size()) {
      if (beyond_.empty()) return false;
      extend();
      continue;
    }
    Window& opened = windows_[window - first_window_];
    if (opened.chunk == none) {
      slot_ += fine_slots;
      continue;
    }
    // Their events are all over memory: fetched all before the first is needed, they take a third
    // of the time.
    opened_.clear();
    std::uint32_t count = opened.count;
    for (std::uint32_t chunk = opened.chunk; chunk != none; count = 15) {
      for (std::uint32_t k = 0; k < count; ++k) {
        __builtin_prefetch(&events_[chunks_[chunk].particle[k]], 0, 2);
        opened_.push_back(chunks_[chunk].particle[k]);
      }
      const std::uint32_t next_chunk = chunks_[chunk].next;
      chunks_[chunk].next = free_chunk_;
      free_chunk_ = chunk;
      chunk = next_chunk;
    }
    opened = {};
    for (const std::uint32_t particle : opened_) {
      const double time = events_[particle].time;
      const double slots = time * slots_per_time_;
      if (slots >= static_cast<double>(slot_) && slots < static_cast<double>(slot_ + fine_slots))
        add_to_slot(static_cast<std::uint32_t>(static_cast<std::uint64_t>(slots) % fine_slots),
                    time, particle);
    }
    return true;
  }
}

void Calendar::extend() {
  // All windows are used up: the same number again, starting where the earliest waiting event is.
  std::vector<std::uint32_t> waiting;
  waiting.swap(beyond_);
  double earliest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t particle : waiting)
    earliest = std::min(earliest, events_[particle].time);
  // An outdated entry's particle has an entry elsewhere too; its time may be long past.
  const double slots = earliest * slots_per_time_;
  if (slots > static_cast<double>(slot_) && slots < 0x1p62)
    slot_ = static_cast<std::uint64_t>(slots) / fine_slots * fine_slots;
  first_window_ = slot_ / fine_slots;
  std::fill(windows_.begin(), windows_.end(), Window{});
  for (const std::uint32_t particle : waiting) {
    const double at = events_[particle].time * slots_per_time_;
    if (at < static_cast<double>(slot_)) continue;  // outdated
    if (!(at < 0x1p62)) continue;                   // never
    const std::uint64_t window = static_cast<std::uint64_t>(at) / fine_slots - first_window_;
    if (window < windows_.size())
      append(windows_[window], particle);
    else
      beyond_.push_back(particle);
  }
}

std::size_t Calendar::memory() const {
  return events_.capacity() * sizeof(Event) + chunks_.capacity() * sizeof(Chunk) +
         nodes_.capacity() * sizeof(Node) + windows_.capacity() * sizeof(Window) +
         (active_.capacity()) * sizeof(Entry) + beyond_.capacity() * sizeof(std::uint32_t);
}

}  // namespace haff::engine
