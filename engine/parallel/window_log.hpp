// What a thread has done within a window: to undo it, and to add up what collisions did in the
// order of their times.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/particles/particle.hpp"
#include "engine/queue/event.hpp"

namespace haff::engine {

// Stands in for the clock while a collision happens, and keeps every term that it adds to a sum.
struct CollisionTerms {
  template <int most>
  struct Terms {
    void operator+=(double term) { value[count++] = term; }
    void operator-=(double term) { value[count++] = -term; }
    double value[most] = {};
    unsigned count = 0;
  };
  struct {
    Terms<2> dissipated;
    Terms<1> virial;
  } tally;
  struct {
    double closest2 = 1;
  } invariants;
};

// The terms of one collision.
struct CollisionRecord {
  double time;
  std::uint64_t rank;  // among collisions of exactly the same time
  double virial;
  double dissipated[2];  // the second one for rough particles only
};

inline bool comes_before(const CollisionRecord& one, const CollisionRecord& other) {
  return one.time != other.time ? one.time < other.time : one.rank < other.rank;
}

// The records and events before they were changed, in the order of the changes.
template <class Memento>
class UndoLog {
 public:
  void clear() {
    events_.clear();
    records_.clear();
    mementos_.clear();
  }
  void save(std::uint32_t particle, const Event& event) { events_.push_back({particle, event}); }
  void save(std::uint32_t particle, const Particle& record) {
    records_.push_back({particle, record});
  }
  void save(const Memento& memento) { mementos_.push_back(memento); }

  template <class RestoreEvent, class RestoreRecord, class RestoreMemento>
  void undo(const RestoreEvent& event, const RestoreRecord& record, const RestoreMemento& memento) {
    for (auto saved = mementos_.rbegin(); saved != mementos_.rend(); ++saved) memento(*saved);
    for (auto saved = records_.rbegin(); saved != records_.rend(); ++saved)
      record(saved->particle, saved->before);
    for (auto saved = events_.rbegin(); saved != events_.rend(); ++saved)
      event(saved->particle, saved->before);
  }
  template <class Visit>
  void for_each_event(const Visit& visit) const {
    for (const auto& saved : events_) visit(saved.particle);
  }

  std::size_t memory() const {
    return events_.capacity() * sizeof(events_[0]) + records_.capacity() * sizeof(records_[0]) +
           mementos_.capacity() * sizeof(Memento);
  }

 private:
  template <class T>
  struct Saved {
    std::uint32_t particle;
    T before;
  };
  std::vector<Saved<Event>> events_;
  std::vector<Saved<Particle>> records_;
  std::vector<Memento> mementos_;
};

}  // namespace haff::engine
