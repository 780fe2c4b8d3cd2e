// SPDX-License-Identifier: GPL-3.0-or-later

// The records and events before a thread changed them within a window, to undo it.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/particles/particle.hpp"
#include "engine/queue/event.hpp"

namespace haff::engine {

// A list that is emptied and filled again and again. Adding to it is a store and a comparison; that
// of std::vector is a call, which takes 2 % of the time of a window.
template <class T>
class Tape {
 public:
  [[gnu::always_inline]] void add(const T& item) {
    if (count_ == room_.size()) [[unlikely]]
      room_.resize(2 * count_ + 64);
    T* const place = room_.data() + count_++;
    *place = item;
    __builtin_prefetch(place + ahead, 1, 3);  // what is written waits for the cache otherwise
  }
  void clear() { count_ = 0; }

  std::size_t size() const { return count_; }
  const T* begin() const { return room_.data(); }
  const T* end() const { return room_.data() + count_; }
  std::size_t memory() const { return room_.capacity() * sizeof(T); }

 private:
  static constexpr std::size_t ahead = 512 / sizeof(T);

  std::vector<T> room_;
  std::size_t count_ = 0;
};

class UndoLog {
 public:
  void clear() {
    events_.clear();
    records_.clear();
    changed_.clear();
  }
  [[gnu::always_inline]] void save(std::uint32_t particle, const Event& event) {
    events_.add({event, particle});
  }
  [[gnu::always_inline]] void save(std::uint32_t particle, const Particle& record) {
    records_.add(record);
    changed_.add(particle);
  }

  // Calls these with everything that was saved, the latest first.
  template <class RestoreEvent, class RestoreRecord>
  void undo(const RestoreEvent& event, const RestoreRecord& record) const {
    for (std::size_t k = records_.size(); k-- > 0;)
      record(changed_.begin()[k], records_.begin()[k]);
    for (const SavedEvent* saved = events_.end(); saved != events_.begin();) {
      --saved;
      event(saved->particle, saved->before);
    }
  }
  // The particles whose events were changed; one may come several times.
  template <class Visit>
  void for_each_particle(const Visit& visit) const {
    for (const SavedEvent& saved : events_) visit(saved.particle);
  }

  std::size_t memory() const { return events_.memory() + records_.memory() + changed_.memory(); }

 private:
  struct SavedEvent {
    Event before;
    std::uint32_t particle;
  };
  Tape<SavedEvent> events_;
  Tape<Particle> records_;
  Tape<std::uint32_t> changed_;  // whose records these are
};

}  // namespace haff::engine
