// SPDX-License-Identifier: GPL-3.0-or-later

// The records and events as they were before a thread changed them in a window, to undo the window.
#pragma once

#include <cstdint>

#include "engine/parallel/tape.hpp"
#include "engine/particles/particle.hpp"
#include "engine/queue/event.hpp"

namespace haff::engine {

class UndoLog {
 public:
  void clear() {
    events_.clear();
    records_.clear();
  }
  // Saves an event that is about to change.
  [[gnu::always_inline]] void save(std::uint32_t particle, const Event& event) {
    *events_.add(1) = {event, particle, 0};
  }
  // Saves the events and records of two particles that are about to collide.
  [[gnu::always_inline]] void save(std::uint32_t p, const Event& event_of_p, const Particle& a,
                                   std::uint32_t q, const Event& event_of_q, const Particle& b) {
    Saved* const event = events_.add(2);
    event[0] = {event_of_p, p, 1};
    event[1] = {event_of_q, q, 1};
    Particle* const record = records_.add(2);
    record[0] = a;
    record[1] = b;
  }

  // Calls these functions with everything that was saved, the latest first.
  template <class RestoreEvent, class RestoreRecord>
  void undo(const RestoreEvent& event, const RestoreRecord& record) const {
    const Particle* of_it = records_.end();
    for (const Saved* saved = events_.end(); saved != events_.begin();) {
      --saved;
      if (saved->records != 0) record(saved->particle, *--of_it);
      event(saved->particle, saved->before);
    }
  }
  // The particles whose events were changed; one may come several times.
  template <class Visit>
  void for_each_particle(const Visit& visit) const {
    for (const Saved& saved : events_) visit(saved.particle);
  }

  std::size_t memory() const { return events_.memory() + records_.memory(); }

 private:
  struct Saved {
    Event before;
    std::uint32_t particle;
    std::uint32_t records;  // the number of records saved with it: 0 or 1
  };
  Tape<Saved> events_;
  Tape<Particle> records_;
};

}  // namespace haff::engine
