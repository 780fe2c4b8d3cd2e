// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/queue/ladder_queue.hpp"

#include <array>
#include <cmath>

namespace haff::engine {
namespace {

// The rank of each of up to 32 different numbers: how many of them are smaller. This compares all
// numbers with all others; there is no branch, and the compiler vectorizes it.
constexpr std::size_t most_ranked = 32;
using Keys = std::array<std::int32_t, most_ranked>;

template <std::size_t padded>
[[gnu::always_inline]] inline void rank_all(const Keys& key, std::size_t count, Keys& rank) {
  alignas(64) std::array<std::int32_t, padded> smaller{};
  for (std::size_t j = 0; j < count; ++j)
    for (std::size_t i = 0; i < padded; ++i) smaller[i] += key[j] < key[i] ? 1 : 0;
  for (std::size_t i = 0; i < padded; ++i) rank[i] = smaller[i];
}

// Two versions are compiled. They compute with integers only, so no bit depends on which one runs.
// The loader chooses, which only that of glibc can; only on x86 is the default target older than
// the processor's vectors. The loader chooses before the thread sanitizer is ready, so that there
// is one version with that sanitizer. (g++ says that it is on; for clang++ the preset tsan does.)
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__SANITIZE_THREAD__)
[[gnu::target_clones("avx2", "default")]]
#endif
void rank_keys(const Keys& key, std::size_t count, Keys& rank) {
  if (count <= most_ranked / 2)
    rank_all<most_ranked / 2>(key, count, rank);
  else
    rank_all<most_ranked>(key, count, rank);
}

}  // namespace

template <class Members>
void LadderQueueOf<Members>::restart(double rate, std::uint32_t foresight) {
  slots_per_time_ = rate / events_per_slot;
  foresight_ = foresight;
  slot_ = 0;
  first_window_ = 0;
  due_.assign(2, never_due);
  head_ = end_ = ahead_ = 0;
  later_chunk_ = none;
  lists_.assign(slots() + 1 + windows_ahead(), {});
  chunks_.clear();
  free_chunk_ = none;
  beyond_.clear();
}

template <class Members>
template <class Visit>
void LadderQueueOf<Members>::empty(List& list, const Visit& visit) {
  std::uint32_t count = list.count;
  for (std::uint32_t chunk = list.chunk; chunk != none; count = in_chunk) {
    for (std::uint32_t k = 0; k < count; ++k) visit(chunks_[chunk].particle[k]);
    const std::uint32_t next_chunk = chunks_[chunk].next;
    chunks_[chunk].next = free_chunk_;
    free_chunk_ = chunk;
    chunk = next_chunk;
  }
  list = {};
}

template <class Members>
void LadderQueueOf<Members>::open_chunk(List& list) {
  std::uint32_t fresh = free_chunk_;
  if (fresh == none) {
    fresh = static_cast<std::uint32_t>(chunks_.size());
    chunks_.emplace_back();
  } else {
    free_chunk_ = chunks_[fresh].next;
  }
  chunks_[fresh].next = list.chunk;
  list = {fresh, 0};
}

template <class Members>
void LadderQueueOf<Members>::add_beyond(std::uint32_t particle) {
  beyond_.push_back(particle);
}

// Makes room for this many more due entries.
template <class Members>
void LadderQueueOf<Members>::make_room(std::size_t count) {
  if (due_.size() < end_ + count + 2) [[unlikely]]
    due_.resize(2 * (end_ + count) + 2);
}

template <class Members>
void LadderQueueOf<Members>::add_to_due(double time, std::uint32_t particle) {
  make_room(1);
  std::size_t k = end_++;
  due_[end_ + 1] = never_due;
  due_[end_] = never_due;
  for (; k > head_ && time < due_[k - 1].time; --k) due_[k] = due_[k - 1];
  due_[k] = {time, particle};
  if (k < ahead_) ++ahead_;
}

// Sorts the first `count` entries of found_ and appends them to the due entries.
template <class Members>
void LadderQueueOf<Members>::sort_in(std::size_t count) {
  make_room(count);
  Entry* const begin = due_.data() + end_;
  Entry* const end = begin + count;
  if (count <= most_ranked) [[likely]] {
    // 26 bits of the time within the slot, and five bits that make the keys different.
    alignas(64) Keys key;
    key.fill(std::numeric_limits<std::int32_t>::max());
    for (std::size_t k = 0; k < count; ++k) {
      const double in_slot = found_[k].time * slots_per_time_ - static_cast<double>(slot_);
      key[k] = static_cast<std::int32_t>(in_slot * 0x1p26) << 5 | static_cast<std::int32_t>(k);
    }
    Keys rank;
    rank_keys(key, count, rank);
    for (std::size_t k = 0; k < count; ++k) begin[rank[k]] = found_[k];
  } else {
    std::copy_n(found_.begin(), count, begin);
  }
  // Too many entries to be ranked, or two that are closer than 2^-26 of a slot.
  const auto sooner = [](const Entry& a, const Entry& b) { return a.time < b.time; };
  if (!std::is_sorted(begin, end, sooner)) [[unlikely]]
    std::sort(begin, end, sooner);
  end[0] = end[1] = never_due;
  end_ += count;
}

template <class Members>
bool LadderQueueOf<Members>::open_next_slot() {
  // Moves the entries that are left from earlier slots to the front.
  for (std::size_t k = head_; k < end_; ++k) due_[k - head_] = due_[k];
  end_ -= head_;
  ahead_ -= std::min(ahead_, head_);
  head_ = 0;
  due_[end_] = due_[end_ + 1] = never_due;
  for (;;) {
    ++slot_;
    if (in_window(slot_) == 0 && !open_next_window()) return false;
    List& list = lists_[in_window(slot_)];
    if (list.chunk == none) continue;
    std::size_t count = 0;
    empty(
        list, [&](std::uint32_t particle) __attribute__((always_inline)) {
          if (count == found_.size()) [[unlikely]]
            found_.resize(2 * count + 16);
          const double time = time_of(particle, never_due.time);
          found_[count] = {time, particle};
          count += slot_of(time) == slot_;
        });
    if (count == 0) continue;
    if (foresight_ > 0) prefetch_later();
    sort_in(count);
    return true;
  }
}

// Prefetches the events of the next slot; and one more chunk of the next window's list, which is a
// chain: one chunk tells where the next one is.
template <class Members>
void LadderQueueOf<Members>::prefetch_later() {
  if (const Slot next = in_window(slot_ + 1); next != 0 && lists_[next].chunk != none)
    for (std::uint32_t k = 0; k < lists_[next].count; ++k)
      __builtin_prefetch(&events_[chunks_[lists_[next].chunk].particle[k]], 1, 2);
  if (later_chunk_ != none) prefetch_chunk(chunks_[later_chunk_].next);
}

template <class Members>
void LadderQueueOf<Members>::prefetch_chunk(std::uint32_t chunk) {
  later_chunk_ = chunk;
  if (chunk == none) return;
  const Chunk& coming = chunks_[chunk];
  __builtin_prefetch(&coming.particle, 1, 2);
  __builtin_prefetch(&coming.next, 1, 2);  // on another line
}

template <class Members>
bool LadderQueueOf<Members>::open_next_window() {
  // slot_ is the first slot of the new window. Skips empty windows.
  for (;;) {
    const Slot window = window_of(slot_);
    if (list_of(window) >= lists_.size()) {
      if (beyond_.empty()) return false;
      extend();
      continue;
    }
    List& list = lists_[list_of(window)];
    if (list.chunk == none) {
      slot_ += slots();
      continue;
    }
    // The events of a window are scattered over memory. Prefetching all of them before the first
    // one is needed takes a third of the time.
    opened_.clear();
    empty(list, [&](std::uint32_t particle) {
      __builtin_prefetch(&events_[particle], 0, 2);
      opened_.push_back(particle);
    });
    for (const std::uint32_t particle : opened_) {
      const Slot slot = slot_of(time_of(particle, never_due.time));
      append(lists_[choose(window_of(slot) == window, in_window(slot), slots())], particle);
    }
    empty(lists_[slots()], [](std::uint32_t) {});
    if (const std::size_t next = list_of(window + 1); foresight_ > 0)
      prefetch_chunk(next < lists_.size() ? lists_[next].chunk : none);
    return true;
  }
}

// Visits particles whose events are scattered over memory.
template <class Members>
template <class Visit>
void LadderQueueOf<Members>::visit_all(const std::vector<std::uint32_t>& particles,
                                       const Visit& visit) const {
  constexpr std::size_t ahead = 32;
  for (std::size_t k = 0; k < particles.size(); ++k) {
    __builtin_prefetch(&events_[particles[std::min(k + ahead, particles.size() - 1)]], 0, 2);
    visit(particles[k]);
  }
}

template <class Members>
void LadderQueueOf<Members>::extend() {
  // All windows are used up. Creates the same number again, starting at the earliest waiting event.
  std::vector<std::uint32_t> waiting;
  waiting.swap(beyond_);
  double earliest = std::numeric_limits<double>::infinity();
  std::uint32_t highest = 0;
  visit_all(waiting, [&](std::uint32_t particle) {
    earliest = std::min(earliest, time_of(particle, never_due.time));
    highest = std::max(highest, particle);
  });
  // An outdated entry's particle has an entry elsewhere too; its time may be long past.
  if (const Slot slot = slot_of(earliest); slot > slot_ && slot != no_slot)
    slot_ = slot - in_window(slot);
  first_window_ = window_of(slot_);
  std::fill(lists_.begin() + static_cast<std::ptrdiff_t>(slots()) + 1, lists_.end(), List{});
  // A particle that has been scheduled several times is taken once. Twice, it would be due twice,
  // and at the same time, which is a matter for settle_tie(): a quarter of the speed.
  std::vector<bool> has_come(highest + std::size_t{1});
  visit_all(waiting, [&](std::uint32_t particle) {
    const Slot slot = slot_of(time_of(particle, never_due.time));
    if (slot < slot_ || slot == no_slot || has_come[particle]) return;  // outdated, never, or again
    has_come[particle] = true;
    if (const std::size_t list = list_of(window_of(slot)); list < lists_.size())
      append(lists_[list], particle);
    else
      add_beyond(particle);
  });
}

template <class Members>
std::size_t LadderQueueOf<Members>::memory() const {
  return storage_.capacity() * sizeof(Event) + chunks_.capacity() * sizeof(Chunk) +
         lists_.capacity() * sizeof(List) + (due_.capacity() + found_.capacity()) * sizeof(Entry) +
         (beyond_.capacity() + opened_.capacity()) * sizeof(std::uint32_t);
}

template class LadderQueueOf<AllParticles>;
template class LadderQueueOf<OwnParticles>;

}  // namespace haff::engine
