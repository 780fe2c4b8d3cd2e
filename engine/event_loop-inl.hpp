// The event loop: the whole simulation between two synchronizations.
//
// One event a particle: touching its partner or leaving its cell, whichever is first. What makes
// that exact: whoever changes course looks at once for its earliest contact among all who are near
// (`predict`), and whoever enters a cell looks at those who have come near by it (`cross`). Of the
// two that will touch next, the one that looked last has seen the other. A partner that has
// collided with somebody else meanwhile is noticed when the time comes, and one looks again.
//
// This file is compiled once for each SIMD target, hence its place in HWY_NAMESPACE.
#if defined(HAFF_ENGINE_EVENT_LOOP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAFF_ENGINE_EVENT_LOOP_INL
#undef HAFF_ENGINE_EVENT_LOOP_INL
#else
#define HAFF_ENGINE_EVENT_LOOP_INL
#endif

#include <hwy/highway.h>

#include "engine/search.hpp"
#include "engine/watchdog.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

// `prefetching`: fetch into cache what coming events will touch (worth_prefetching, gas.hpp).
template <class Search, class Physics, bool prefetching = false>
class EventLoop {
 public:
  EventLoop(Gas& gas, Physics& physics)
      : gas_(gas),
        physics_(physics),
        search_(gas, physics),
        now_(gas.clock.now),
        collisions_(gas.clock.collisions) {}

  // Goes on until the given number of collisions in all, or until that time. Throws Collapse.
  void run(std::int64_t collisions, double end = never) {
    while (collisions_ < collisions) {
      const std::uint32_t p = gas_.calendar.next([this](std::uint32_t q) { return rank(q); });
      if (p == Calendar::nobody) throw Breakdown("no particle will ever meet another again");
      if constexpr (prefetching) look_ahead();
      const Event& event = gas_.calendar[p];
      if (event.time > end) {
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
        look_again(p);
    }
    gas_.clock.now = now_;
    gas_.clock.collisions = collisions_;
  }

  // Everybody's first event, after a synchronization. It is enough that one of two sees the other.
  void predict_all() {
    for (std::uint32_t p = 0; p < gas_.particles.size(); ++p)
      expect(p, search_.around_higher(p, gas_.calendar[p].cell));
  }

 private:
  void collide(std::uint32_t p, std::uint32_t q) {
    const double p_time = gas_.particles[p].time;
    const double q_time = gas_.particles[q].time;
    const double approach =
        physics_.collide(gas_.particles[p], gas_.particles[q], now_, gas_.box, gas_.clock);
    gas_.calendar.forget(q);
    ++collisions_;
    ++gas_.events.collisions;
    if (approach > -slow_approach) [[unlikely]]
      watch(p, q, std::min(p_time, q_time));
    const auto [first, second] =
        search_.around_both(p, gas_.calendar[p].cell, q, gas_.calendar[q].cell);
    expect(p, first);
    expect(q, second);
  }

  [[gnu::noinline]] void watch(std::uint32_t p, std::uint32_t q, double since) {
    gas_.clock.now = now_;
    gas_.clock.collisions = collisions_;
    note_slow_collision(gas_, p, q, since);
  }

  void cross(std::uint32_t p) {
    ++gas_.events.crossings;
    Event& event = gas_.calendar[p];
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

  void look_again(std::uint32_t p) {
    ++gas_.events.stale;
    expect(p, search_.around(p, gas_.calendar[p].cell, now_));
  }

  // Of all who are near p the first to touch it is this one.
  HWY_INLINE void expect(std::uint32_t p, const Contact& contact) {
    Event& event = gas_.calendar[p];
    event.contact_time = contact.time;
    event.partner = contact.partner;
    event.partner_changes = gas_.particles[contact.partner].changes;
    schedule(p);
  }

  // p touches its partner, or leaves its cell.
  HWY_INLINE void schedule(std::uint32_t p) {
    Event& event = gas_.calendar[p];
    const Exit exit = search_.exit(p, event.cell, now_);
    event.time = std::min(event.contact_time, exit.time);
    event.face = choose(event.contact_time <= exit.time, Event::contact, exit.face);
    gas_.calendar.schedule(p);
  }

  // What the coming events need, in four steps, each of which needs the one before to have arrived:
  // the particle and its event; its partner, and the bricks around it; the particles in those, and
  // the bricks around the partner; the particles in those. All but the particles into the
  // second-level cache.
  // (GCC deletes the call of a lambda that does nothing but prefetch.)
  void look_ahead() {
    {
      const std::uint32_t p = gas_.calendar.coming(4 * stride);
      __builtin_prefetch(gas_.particles.data() + p, 1, 2);
      __builtin_prefetch(&gas_.calendar[p], 1, 2);
    }
    if (const Event& event = coming(3 * stride); event.face == Event::contact) {
      __builtin_prefetch(gas_.particles.data() + event.partner, 1, 2);
      __builtin_prefetch(&gas_.calendar[event.partner], 1, 2);
      search_.prefetch_bricks_around(event.cell);
    } else {
      search_.prefetch_bricks_beyond(event.cell, event.face);
    }
    if (const Event& event = coming(2 * stride); event.face == Event::contact) {
      search_.prefetch_particles_around(event.cell);
      const Cell partner = gas_.calendar[event.partner].cell;
      if (partner != event.cell) search_.prefetch_bricks_around(partner);
    } else {
      search_.prefetch_particles_beyond(event.cell, event.face);
    }
    if (!huge_) return;
    if (const Event& event = coming(stride);
        event.face == Event::contact && gas_.calendar[event.partner].cell != event.cell)
      search_.prefetch_particles_around(gas_.calendar[event.partner].cell);
  }
  const Event& coming(std::uint32_t places) const {
    return gas_.calendar[gas_.calendar.coming(places)];
  }

  // Order among events of the very same time: crossings, then contacts by their particles' ids.
  std::uint64_t rank(std::uint32_t p) const {
    const Event& event = gas_.calendar[p];
    if (event.face != Event::contact) return 0;
    const std::uint64_t a = gas_.particles[p].id;
    const std::uint64_t b = gas_.particles[event.partner].id;
    return 1 + (std::min(a, b) << 32 | std::max(a, b));
  }

  static constexpr std::uint32_t stride = foresight / 4;  // events between steps of look_ahead()

  Gas& gas_;
  Physics& physics_;
  // Beyond the third-level cache. Below, most of what is near the partner is there anyway, and the
  // fourth step costs more than it gains.
  const bool huge_ = gas_.particles.size() > 200000;
  Search search_;
  double now_;
  std::int64_t collisions_;
};

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
