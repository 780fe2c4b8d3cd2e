// SPDX-License-Identifier: GPL-3.0-or-later

// The first phase of a window: every thread processes the events inside its slab, in their order.
//
// An event that needs a cell outside the slab is deferred to the zone around that border. The event
// may change the cells around it, so these are frozen until then: an event near a frozen cell is
// deferred, too.
//
// This file is compiled once for each SIMD target, hence its place in HWY_NAMESPACE.
#if defined(HAFF_ENGINE_SLAB_LOOP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAFF_ENGINE_SLAB_LOOP_INL
#undef HAFF_ENGINE_SLAB_LOOP_INL
#else
#define HAFF_ENGINE_SLAB_LOOP_INL
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "engine/parallel/any_loops.hpp"
#include "engine/parallel/region_events-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

template <class Search, class Physics>
class alignas(128) SlabLoop final : public AnySlabLoop,
                                    RegionEvents<SlabLoop<Search, Physics>, Search, Physics> {
  using Base = RegionEvents<SlabLoop, Search, Physics>;
  friend Base;

 public:
  SlabLoop(Gas& gas, Physics& physics, Region& region)
      : Base(gas, physics), region_(region), division_(region.division) {}

  void begin_window() override { this->mementos_.clear(); }
  void undo_collisions() override { this->mementos_.restore(this->physics_); }

  void predict(std::uint32_t begin, std::uint32_t end) override {
    this->now_ = 0;
    is_beginning_ = true;
    for (std::uint32_t p = begin; p < end; ++p)
      this->set_prediction(p, this->search_.around_higher(p, this->gas_.queue[p].cell));
    is_beginning_ = false;
  }

  // An exception is left to the loop of one thread.
  void work(double begin, double end) override try {
    this->now_ = begin;
    slab_ = region_.slab();
    workable_ = slab_.workable();
    deep_ = slab_.deep();
    set_reach(Slab::border);
    while (!done_.violated) {
      const std::uint32_t p = region_.queue.next([this](std::uint32_t q) { return this->rank(q); });
      if (p == LadderQueue::nothing) break;
      const Event& event = this->gas_.queue[p];
      if (event.time >= end) {
        region_.queue.put_back();
        break;
      }
      prefetch_upcoming();
      if (event.time < this->now_) [[unlikely]] {
        // Rounding: only the loop of one thread knows what the present time is then.
        region_.queue.put_back();
        done_.violated = true;
        break;
      }
      this->now_ = event.time;
      if (event.face != Event::contact)
        try_to_cross(p);
      else
        try_to_collide(p, event.partner);
    }
    thaw();
  } catch (const PhysicsError&) {
    done_.violated = true;
    thaw();
  }

 private:
  HWY_INLINE void try_to_cross(std::uint32_t p) {
    const Event& event = this->gas_.queue[p];
    is_far_ = far_.hold(event.cell);
    if (!is_far_) {
      const Cell to = this->gas_.bricks.across(event.cell, event.face);
      if (HWY_UNLIKELY(!(may_touch(event.cell) && may_touch(to)))) return defer(p, to);
    }
    this->cross(p);
  }

  HWY_INLINE void try_to_collide(std::uint32_t p, std::uint32_t q) {
    const Event& event = this->gas_.queue[p];
    is_far_ = far_.hold(event.cell);
    // If the contact was expected far from the border, a partner in another slab cannot be there:
    // it has collided. If the contact was near the border, the events around it in this slab have
    // to wait anyway.
    if (HWY_LIKELY(is_own(q)) && this->gas_.particles[q].changes == event.partner_changes) {
      const Cell there = this->gas_.queue[q].cell;
      if (HWY_UNLIKELY(!is_far_ && !(may_touch(event.cell) && may_touch(there))))
        return defer(p, there);
      this->collide(p, q);
    } else {
      if (HWY_UNLIKELY(!is_far_ && !may_touch(event.cell))) return defer(p, event.cell);
      this->repredict(p);
    }
  }

  // Whether this cell may change now. Farther inside the slab than `reach_`, which is not far, no
  // cell is frozen.
  HWY_INLINE bool may_touch(Cell cell) const {
    return HWY_LIKELY(untouched_.hold(cell)) || (workable_.hold(cell) && !is_frozen(cell));
  }
  HWY_NOINLINE bool is_frozen(Cell cell) const {
    unsigned frozen = 0;
    this->visit_bricks_around(cell, [&](std::size_t n, std::uint32_t brick, bool) {
      frozen |= division_.frozen[brick] & Bricks::near_cells(n, cell);
    });
    return frozen != 0;
  }

  void defer(std::uint32_t p, Cell there) {
    const Cell here = this->gas_.queue[p].cell;
    defer_to_zone(p, here);
    freeze(here);
    if (there != here) freeze(there);
  }
  void defer_to_zone(std::uint32_t p, Cell here) {
    if (slab_.beyond_zones().hold(here)) done_.violated = true;
    region_.deferred[division_.slabs.zone_of(here)].push_back({this->now_, p});
  }

  // Freezes the cells around a cell that are in the own slab.
  void freeze(Cell cell) {
    const bool own = slab_.holds_brick_of(cell);
    const bool next = slab_.holds_brick_next_to(cell);
    // Nothing in this slab reads a brick that belongs to two slabs.
    this->visit_bricks_around(cell, [&](std::size_t n, std::uint32_t brick, bool in_next_layer) {
      if (!(in_next_layer ? next : own)) return;
      *frozen_.add(1) = brick;
      division_.frozen[brick] |= Bricks::near_cells(n, cell);
    });
    // An event that waits reads one layer of cells more than its own, and so does one that does
    // not.
    if (const std::uint32_t reach = slab_.depth(cell) + 3; reach > reach_) set_reach(reach);
  }
  // Cells with at least this many layers between them and the border have no frozen cell near them.
  // Cells one layer farther inside, which with their neighbours are out of the reach of zones, need
  // no further check.
  void set_reach(std::uint32_t layers) {
    reach_ = layers;
    untouched_ = slab_.inside(layers);
    const std::uint32_t far = std::max(layers, slab_.zone_cells()) + 1;
    far_ = slab_.inside(far);
  }
  void thaw() {
    for (const std::uint32_t brick : frozen_) division_.frozen[brick] = 0;
    frozen_.clear();
  }

  // ---- the marks of an event ------------------------------------------------------------------

  Events& counts() { return done_.events; }
  HWY_INLINE void keep(std::uint32_t p) { done_.log.save(p, this->gas_.queue[p]); }
  HWY_INLINE void touch(Cell cell) {
    if (is_far_ || deep_.hold(cell)) return;
    division_.marks[Division::mark_of(this->gas_.bricks.brick_of(cell) / Bricks::slots,
                                      deep_.of(cell) % 2)] = static_cast<float>(this->now_);
  }
  HWY_INLINE void meet(std::uint32_t p, std::uint32_t q) {
    this->meet_for_now(p, q, done_, region_.closest2);
    region_.queue.forget(q);
  }
  HWY_INLINE void put(std::uint32_t p) {
    if (HWY_LIKELY(!is_beginning_)) region_.queue.schedule(p);
  }

  // ---- prefetching ----------------------------------------------------------------------------

  // As in the event loop of one thread, but it looks only at what belongs to the region: events of
  // own particles, which are in the slab, and cells next to them. (Those on the other side of the
  // border change as little as those on this side, and so do those in the same brick.)
  HWY_INLINE void prefetch_upcoming() {
    const auto& events = this->gas_.queue;
    const auto* const particles = this->gas_.particles.data();
    auto& search = this->search_;
    do {
      const std::uint32_t next = region_.queue.look_ahead();
      if (next == LadderQueue::nothing) return;
      this->upcoming_.add(next);
      __builtin_prefetch(particles + next, 1, 2);
      if (const Event& event = events[next]; event.face == Event::contact) {
        __builtin_prefetch(particles + event.partner, 1, 2);
        __builtin_prefetch(&events[event.partner], 1, 2);
        search.prefetch_bricks_around(event.cell);
      } else {
        search.prefetch_bricks_beyond(event.cell, event.face);
      }
      if (const std::uint32_t p = this->upcoming_.before_newest(prefetch_stride); is_own(p)) {
        const Event& event = events[p];
        if (event.face == Event::contact) {
          search.prefetch_particles_around(event.cell);
          if (is_own(event.partner) && events[event.partner].cell != event.cell)
            search.prefetch_bricks_around(events[event.partner].cell);
        } else if (workable_.hold(this->gas_.bricks.across(event.cell, event.face))) {
          search.prefetch_particles_beyond(event.cell, event.face);
        }
      }
      if (!huge_) continue;
      if (const std::uint32_t p = this->upcoming_.before_newest(2 * prefetch_stride); is_own(p)) {
        const Event& event = events[p];
        if (event.face == Event::contact && is_own(event.partner) &&
            events[event.partner].cell != event.cell)
          search.prefetch_particles_around(events[event.partner].cell);
      }
    } while (!region_.queue.looks_far());
  }
  HWY_INLINE bool is_own(std::uint32_t p) const {
    return this->gas_.queue[p].owner == region_.number;
  }

  Region& region_;
  Region::Done& done_ = region_.in(Phase::slab);
  Division& division_;
  Slab slab_;
  bool is_beginning_ = false;
  const bool huge_ = this->gas_.particles.size() > 200000;
  Layers workable_;   // Slab
  Layers deep_;       // Slab
  Layers untouched_;  // set_reach()
  Layers far_;        // set_reach()
  std::uint32_t reach_ = 0;
  bool is_far_ = false;         // the present event
  Tape<std::uint32_t> frozen_;  // bricks; one may come several times
};

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
