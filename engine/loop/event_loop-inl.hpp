// SPDX-License-Identifier: GPL-3.0-or-later

// The event loop: the whole simulation between two synchronizations.
//
// Each particle has one event: it touches its partner or leaves its cell, whichever comes first.
// This is exact because a particle whose velocity changes searches at once for its earliest contact
// among all particles nearby (`collide`), and a particle that enters a cell searches among those
// that are nearby now and were not before (`cross`). Of the two particles that will touch next, the
// one that searched last has seen the other. If the partner has collided with a third particle
// meanwhile, this is noticed when the time of the event comes, and the particle searches again
// (`repredict`).
//
// This file is compiled once for each SIMD target, hence its place in HWY_NAMESPACE.
#if defined(HAFF_ENGINE_EVENT_LOOP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAFF_ENGINE_EVENT_LOOP_INL
#undef HAFF_ENGINE_EVENT_LOOP_INL
#else
#define HAFF_ENGINE_EVENT_LOOP_INL
#endif

#include <hwy/highway.h>

#include "engine/loop/watchdog.hpp"
#include "engine/queue/upcoming.hpp"
#include "engine/search/plain_search.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

// `prefetching`: whether the data of the next events are fetched into cache (worth_prefetching,
// gas.hpp).
template <class Search, class Physics, bool prefetching = false>
class EventLoop {
 public:
  EventLoop(Gas& gas, Physics& physics)
      : gas_(gas),
        physics_(physics),
        search_(gas, physics),
        now_(gas.clock.now),
        collisions_(gas.clock.collisions) {}

  // Runs until the given total number of collisions, or until the time `end`. Throws Collapse.
  void run(std::int64_t collisions, double end = never) {
    while (collisions_ < collisions) {
      const std::uint32_t p = gas_.queue.next([this](std::uint32_t q) { return rank(q); });
      if (p == LadderQueue::nothing) throw PhysicsError("no particle will ever meet another again");
      if constexpr (prefetching) prefetch_upcoming();
      const Event& event = gas_.queue[p];
      if (event.time > end) {
        gas_.queue.put_back();
        now_ = end;
        break;
      }
      if (event.time < now_) [[unlikely]]
        ++gas_.clock.invariants.past_events;  // time does not run backwards
      else
        now_ = event.time;
      if (event.face != Event::contact)
        cross(p);
      else if (gas_.particles[event.partner].changes == event.partner_changes)
        collide(p, event.partner);
      else
        repredict(p);
    }
    gas_.clock.now = now_;
    gas_.clock.collisions = collisions_;
  }

  // Finds the first event of every particle, after a synchronization. It is enough that one of two
  // particles finds the other.
  void predict_all() {
    for (std::uint32_t p = 0; p < gas_.particles.size(); ++p)
      set_prediction(p, search_.around_higher(p, gas_.queue[p].cell));
  }

 private:
  void collide(std::uint32_t p, std::uint32_t q) {
    const double p_time = gas_.particles[p].time;
    const double q_time = gas_.particles[q].time;
    const double approach =
        physics_.collide(gas_.particles[p], gas_.particles[q], now_, gas_.box, gas_.clock);
    gas_.queue.forget(q);
    ++collisions_;
    ++gas_.events.collisions;
    if (approach > -slow_approach) [[unlikely]]
      watch(p, q, std::min(p_time, q_time));
    const auto [first, second] = search_.around_both(p, gas_.queue[p].cell, q, gas_.queue[q].cell);
    set_prediction(p, first);
    set_prediction(q, second);
  }

  [[gnu::noinline]] void watch(std::uint32_t p, std::uint32_t q, double since) {
    gas_.clock.now = now_;
    gas_.clock.collisions = collisions_;
    note_slow_collision(gas_, p, q, since);
  }

  void cross(std::uint32_t p) {
    ++gas_.events.crossings;
    Event& event = gas_.queue[p];
    event.cell = gas_.bricks.cross(p, event.cell, event.face);
    const Contact contact = search_.beyond(p, event.cell, event.face, now_);
    const Contact known{event.contact_time, event.partner};
    const std::uint32_t changes = gas_.particles[contact.partner].changes;
    const bool earlier = comes_before(contact, known, gas_.particles);
    event.contact_time = choose(earlier, contact.time, known.time);
    event.partner = choose(earlier, contact.partner, known.partner);
    event.partner_changes = choose(earlier, changes, event.partner_changes);
    schedule(p);
  }

  void repredict(std::uint32_t p) {
    ++gas_.events.stale;
    set_prediction(p, search_.around(p, gas_.queue[p].cell, now_));
  }

  // Sets p's next contact and schedules its event.
  HWY_INLINE void set_prediction(std::uint32_t p, const Contact& contact) {
    Event& event = gas_.queue[p];
    event.contact_time = contact.time;
    event.partner = contact.partner;
    event.partner_changes = gas_.particles[contact.partner].changes;
    schedule(p);
  }

  // Schedules the event of p: it touches its partner, or leaves its cell.
  HWY_INLINE void schedule(std::uint32_t p) {
    Event& event = gas_.queue[p];
    const Exit exit = search_.exit(p, event.cell, now_);
    event.time = std::min(event.contact_time, exit.time);
    event.face = static_cast<std::uint8_t>(
        choose(event.contact_time <= exit.time, Event::contact, exit.face));
    gas_.queue.schedule(p);
  }

  // Prefetches the data of the next events, in three steps, each of which needs the results of the
  // one before: the particle, its partner, and the bricks around it; the particles in these bricks
  // and the bricks around the partner; the particles in those. (The event itself is in cache: the
  // queue has just looked at it.) All but the particles go into the second-level cache. (GCC
  // deletes the call of a lambda that does nothing but prefetch.)
  void prefetch_upcoming() {
    do {
      const std::uint32_t p = gas_.queue.look_ahead();
      if (p == LadderQueue::nothing) return;
      upcoming_.add(p);
      __builtin_prefetch(gas_.particles.data() + p, 1, 2);
      if (const Event& event = gas_.queue[p]; event.face == Event::contact) {
        __builtin_prefetch(gas_.particles.data() + event.partner, 1, 2);
        __builtin_prefetch(&gas_.queue[event.partner], 1, 2);
        search_.prefetch_bricks_around(event.cell);
      } else {
        search_.prefetch_bricks_beyond(event.cell, event.face);
      }
      if (const Event& event = upcoming(prefetch_stride); event.face == Event::contact) {
        search_.prefetch_particles_around(event.cell);
        const Cell partner = gas_.queue[event.partner].cell;
        if (partner != event.cell) search_.prefetch_bricks_around(partner);
      } else {
        search_.prefetch_particles_beyond(event.cell, event.face);
      }
      if (!huge_) continue;
      if (const Event& event = upcoming(2 * prefetch_stride);
          event.face == Event::contact && gas_.queue[event.partner].cell != event.cell)
        search_.prefetch_particles_around(gas_.queue[event.partner].cell);
    } while (!gas_.queue.looks_far());
  }
  const Event& upcoming(std::uint32_t places) const {
    return gas_.queue[upcoming_.before_newest(places)];
  }

  // The order among events of exactly the same time: crossings, then contacts by their particles'
  // ids.
  std::uint64_t rank(std::uint32_t p) const {
    const Event& event = gas_.queue[p];
    if (event.face != Event::contact) return 0;
    const std::uint64_t a = gas_.particles[p].id;
    const std::uint64_t b = gas_.particles[event.partner].id;
    return 1 + (std::min(a, b) << 32 | std::max(a, b));
  }

  Gas& gas_;
  Physics& physics_;
  Upcoming upcoming_;
  // Whether the gas exceeds the third-level cache. If not, most of what is near the partner is in
  // cache anyway, and the third step of prefetching costs more than it gains.
  const bool huge_ = gas_.particles.size() > 200000;
  Search search_;
  double now_;
  std::int64_t collisions_;
};

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
