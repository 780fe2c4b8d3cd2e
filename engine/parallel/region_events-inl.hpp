// SPDX-License-Identifier: GPL-3.0-or-later

// The effects of an event on the particles and on later events, as in the event loop of one thread
// (event_loop-inl.hpp). Every loop decides for itself what it records on the way, and where it
// keeps the next event of a particle.
//
// This file is compiled once for each SIMD target, hence its place in HWY_NAMESPACE.
#if defined(HAFF_ENGINE_REGION_EVENTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAFF_ENGINE_REGION_EVENTS_INL
#undef HAFF_ENGINE_REGION_EVENTS_INL
#else
#define HAFF_ENGINE_REGION_EVENTS_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <atomic>
#include <type_traits>

#include "engine/loop/watchdog.hpp"
#include "engine/parallel/region.hpp"
#include "engine/search/plain_search.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

// The data beside the particles' records that collisions have changed in a window.
template <class Physics>
class Mementos {
  using Memento = typename Physics::Memento;

 public:
  void clear() { tape_.clear(); }
  HWY_INLINE void add(const Memento& memento) {
    if constexpr (!std::is_empty_v<Memento>) *tape_.add(1) = memento;
  }
  void restore(Physics& physics) const {
    for (const Memento* saved = tape_.end(); saved != tape_.begin();) physics.restore(*--saved);
  }

 private:
  Tape<Memento> tape_;
};

// `Loop` derives from this and has
//   void keep(p)        saves the event of p before it changes;
//   void meet(p, q)     saves the events and records of two particles, and lets them collide;
//   void touch(cell)    records a change in a cell;
//   void put(p)         stores the next event of p, which is at gas.queue[p].time;
//   Events& counts()    counts events.
template <class Loop, class Search, class Physics>
class RegionEvents {
 protected:
  RegionEvents(Gas& gas, Physics& physics) : gas_(gas), physics_(physics), search_(gas, physics) {}

  void collide(std::uint32_t p, std::uint32_t q) {
    const Cell p_cell = gas_.queue[p].cell;
    const Cell q_cell = gas_.queue[q].cell;
    loop().touch(p_cell);
    loop().touch(q_cell);
    loop().meet(p, q);
    ++loop().counts().collisions;
    const auto [first, second] = search_.around_both(p, p_cell, q, q_cell);
    set_prediction(p, first);
    set_prediction(q, second);
  }

  void cross(std::uint32_t p) {
    Event& event = gas_.queue[p];
    loop().keep(p);
    loop().touch(event.cell);
    ++loop().counts().crossings;
    const Cell to = gas_.bricks.cross(p, event.cell, event.face);
    loop().touch(to);
    std::atomic_ref(event.cell.packed).store(to.packed, std::memory_order_relaxed);
    const Contact contact = search_.beyond(p, to, event.face, now_);
    // Without a contact, the partner may belong to another thread.
    const std::uint32_t partner = choose(contact.time < never, contact.partner, p);
    const Contact known{event.contact_time, event.partner};
    const std::uint32_t changes = gas_.particles[partner].changes;
    const bool earlier = engine::comes_before(contact, known, gas_.particles);
    event.contact_time = choose(earlier, contact.time, known.time);
    event.partner = choose(earlier, partner, known.partner);
    event.partner_changes = choose(earlier, changes, event.partner_changes);
    schedule(p);
  }

  void repredict(std::uint32_t p) {
    const Cell cell = gas_.queue[p].cell;
    loop().keep(p);
    loop().touch(cell);
    ++loop().counts().stale;
    set_prediction(p, search_.around(p, cell, now_));
  }

  // The order among events of exactly the same time (EventLoop).
  std::uint64_t rank(std::uint32_t p) const {
    const Event& event = gas_.queue[p];
    if (event.face != Event::contact) return 0;
    return rank_of(gas_.particles[p], gas_.particles[event.partner]);
  }
  static std::uint64_t rank_of(const Particle& a, const Particle& b) {
    return 1 + (std::uint64_t{std::min(a.id, b.id)} << 32 | std::max(a.id, b.id));
  }

  // Processes a collision within a window that may have to be undone.
  HWY_INLINE void meet_for_now(std::uint32_t p, std::uint32_t q, Region::Done& done,
                               double& closest2) {
    Particle& a = gas_.particles[p];
    Particle& b = gas_.particles[q];
    done.log.save(p, gas_.queue[p], a, q, gas_.queue[q], b);
    mementos_.add(physics_.memento(a, b));
    CollisionTerms terms;
    const double approach = physics_.collide(a, b, now_, gas_.box, terms);
    if (approach > -slow_approach) [[unlikely]]
      done.violated = true;  // a matter for the watchdog
    closest2 = std::min(closest2, terms.invariants.closest2);
    const auto& lost = terms.tally.dissipated.value;
    *done.collisions.add(1) = {
        now_, rank_of(a, b), terms.tally.virial.value[0], {lost[0], lost[1]}};
  }

  // Sends the event of p to the queue of the slab that p is in, for a later window.
  void send(std::uint32_t p, Region& from) { from.send(p, gas_.queue[p]); }

  HWY_INLINE void set_prediction(std::uint32_t p, const Contact& contact) {
    Event& event = gas_.queue[p];
    event.contact_time = contact.time;
    event.partner = contact.time < never ? contact.partner : p;
    event.partner_changes = gas_.particles[event.partner].changes;
    schedule(p);
  }

  HWY_INLINE void schedule(std::uint32_t p) {
    Event& event = gas_.queue[p];
    const Exit exit = search_.exit(p, event.cell, now_);
    event.time = std::min(event.contact_time, exit.time);
    event.face = static_cast<std::uint8_t>(
        choose(event.contact_time <= exit.time, Event::contact, exit.face));
    loop().put(p);
  }

  // Calls visit(n, brick, in_next_layer) for the bricks around a cell, in the order of
  // Bricks::around(): `brick` counts bricks; the first half of them is in the layer of bricks that
  // the cell is in, the second half in the next one that has neighbours of the cell.
  template <class Visit>
  HWY_INLINE void visit_bricks_around(Cell cell, const Visit& visit) const {
    const auto visit_all = [&](const auto& bricks) __attribute__((always_inline)) {
      for (std::size_t n = 0; n < bricks.size(); ++n)
        visit(n, bricks[n] / Bricks::slots, n >= bricks.size() / 2);
    };
    if (gas_.box.d == 2)
      visit_all(gas_.bricks.template around<2>(cell).brick);
    else
      visit_all(gas_.bricks.template around<3>(cell).brick);
  }

  // Prefetches what the next events of a window's queue need, as in the event loop of one thread.
  // Only cells that may be read are looked at.
  template <class MayRead>
  HWY_INLINE void prefetch_upcoming(WindowQueue& queue, const MayRead& may_read) {
    const Particle* const particles = gas_.particles.data();
    const auto upcoming = [this](std::uint32_t places) -> const Event& {
      return gas_.queue[upcoming_.before_newest(places)];
    };
    do {
      const std::uint32_t next = queue.look_ahead();
      if (next == WindowQueue::nothing) return;
      upcoming_.add(next);
      __builtin_prefetch(particles + next, 1, 2);
      if (const Event& event = gas_.queue[next]; event.face == Event::contact) {
        __builtin_prefetch(particles + event.partner, 1, 2);
        __builtin_prefetch(&gas_.queue[event.partner], 1, 2);
        search_.prefetch_bricks_around(event.cell);
      } else {
        search_.prefetch_bricks_beyond(event.cell, event.face);
      }
      if (const Event& event = upcoming(prefetch_stride); may_read(event.cell)) {
        if (event.face == Event::contact) {
          search_.prefetch_particles_around(event.cell);
          const Cell there = cell_of_another(event.partner);
          if (there != event.cell) search_.prefetch_bricks_around(there);
        } else if (may_read(gas_.bricks.across(event.cell, event.face))) {
          search_.prefetch_particles_beyond(event.cell, event.face);
        }
      }
      if (const Event& event = upcoming(2 * prefetch_stride); event.face == Event::contact) {
        const Cell there = cell_of_another(event.partner);
        if (there != event.cell && may_read(there)) search_.prefetch_particles_around(there);
      }
    } while (!queue.looks_far());
  }

  // The cell of a particle that another thread may just be moving.
  HWY_INLINE Cell cell_of_another(std::uint32_t p) const {
    return {std::atomic_ref(gas_.queue[p].cell.packed).load(std::memory_order_relaxed)};
  }

  Gas& gas_;
  Physics& physics_;
  Search search_;
  Upcoming upcoming_;
  double now_ = 0;
  Mementos<Physics> mementos_;

 private:
  Loop& loop() { return static_cast<Loop&>(*this); }
};

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
