// SPDX-License-Identifier: GPL-3.0-or-later

// A thread's share of a gas: the events of the particles in its slab, and its work in the present
// window.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/loop/gas.hpp"
#include "engine/parallel/collision_terms.hpp"
#include "engine/parallel/division.hpp"
#include "engine/parallel/window_log.hpp"
#include "engine/parallel/window_queue.hpp"

namespace haff::engine {

// The phases of a window, in their order.
enum class Phase : std::uint8_t { slab, zone };
inline constexpr std::size_t phases = 2;

// (Aligned, like the loops of a region, to two cache lines, which the processor fetches together:
// no thread writes to one that another reads.)
struct alignas(128) Region {
  // The work of one phase.
  struct Done {
    UndoLog log;
    Tape<CollisionRecord> collisions;  // in the order of time
    Events events;
    // Whether an event was found that only the loop of one thread can process in its order.
    bool violated = false;

    void clear() {
      log.clear();
      collisions.clear();
      events = {};
      violated = false;
    }
  };

  Region(Gas& gas, Division& shared, unsigned which)
      : number(which),
        division(shared),
        queue(&gas.queue[0], static_cast<std::uint32_t>(gas.particles.size()) / shared.regions,
              {static_cast<std::uint8_t>(which)}),
        deferred(shared.regions),
        outbox(shared.regions) {}

  const Slab& slab() const { return division.slabs.slab(number); }
  const Zone& zone() const { return division.slabs.zone(number); }
  Done& in(Phase phase) { return done[static_cast<std::size_t>(phase)]; }

  void begin_window() {
    closest2 = 1;
    for (Done& phase : done) phase.clear();
    for (auto& list : deferred) list.clear();
  }

  // Sends an event after the window to the queue of the slab that the particle is in.
  void send(std::uint32_t p, Event& event) {
    event.owner = division.slabs.slab_of(event.cell);
    outbox[event.owner].push_back(p);
  }
  template <class Regions>
  void take_mail(const Regions& regions) {
    for (const auto& region : regions) {
      for (const std::uint32_t p : region->outbox[number]) queue.schedule(p);
      region->outbox[number].clear();
    }
  }

  std::size_t memory() const {
    std::size_t bytes = queue.memory() + ordered.memory() + merged.memory();
    for (const Done& phase : done) bytes += phase.log.memory() + phase.collisions.memory();
    for (const auto& list : deferred) bytes += list.capacity() * sizeof(WindowQueue::Entry);
    for (const auto& list : outbox) bytes += list.capacity() * sizeof(std::uint32_t);
    return bytes;
  }

  const unsigned number;
  Division& division;
  LadderQueueOf<OwnParticles> queue;
  std::vector<std::vector<WindowQueue::Entry>> deferred;  // to each zone, in the order of time
  std::vector<std::vector<std::uint32_t>> outbox;         // events after the window, by slab
  std::array<Done, phases> done;
  Tape<CollisionRecord> ordered;  // collisions of both phases, in the order of time
  Tape<CollisionRecord> merged;   // with those of another region
  double closest2 = 1;
};

}  // namespace haff::engine
