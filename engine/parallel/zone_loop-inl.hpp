// SPDX-License-Identifier: GPL-3.0-or-later

// The second phase of a window: every thread processes the events that were deferred to the zone
// around the border below its slab.
//
// Why the result does not depend on the division. Suppose that an event X, which is earlier than an
// event Y, was processed after Y. Within one slab or one zone events are processed in their order;
// slabs do not touch each other (slabs.hpp), and neither do zones. So X is in a zone, and Y was in
// a slab. If neither reads a cell in which the other one changes something, the order of the two is
// immaterial. If one does, then a cell of a particle of Y is next to (or the same as) a cell of a
// particle of X, since an event reads the cells next to those of its particles and changes only
// these. That cell is not deep inside the slab, where X does not read; so Y has left its time as a
// mark on its layer of its brick, and X finds this mark, which is later than its own time, in the
// layers of bricks that it reads. So such a case is always noticed: the window is undone and
// processed in one piece.
//
// An event also checks whether its partner has collided. If the partner is not in a cell next to
// that of the event's particle, it has collided; and if this collision was later than the event,
// the partner has left that neighbourhood since, and has left a mark there.
//
// This file is compiled once for each SIMD target, hence its place in HWY_NAMESPACE.
#if defined(HAFF_ENGINE_ZONE_LOOP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAFF_ENGINE_ZONE_LOOP_INL
#undef HAFF_ENGINE_ZONE_LOOP_INL
#else
#define HAFF_ENGINE_ZONE_LOOP_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <atomic>

#include "engine/parallel/any_loops.hpp"
#include "engine/parallel/region_events-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

template <class Search, class Physics>
class alignas(128) ZoneLoop final : public AnyZoneLoop,
                                    RegionEvents<ZoneLoop<Search, Physics>, Search, Physics> {
  using Base = RegionEvents<ZoneLoop, Search, Physics>;
  friend Base;

 public:
  ZoneLoop(Gas& gas, Physics& physics, Region& region)
      : Base(gas, physics), region_(region), division_(region.division), queue_(&gas.queue[0]) {}

  void begin_window() override { this->mementos_.clear(); }
  void undo_collisions() override { this->mementos_.restore(this->physics_); }

  // An exception is left to the loop of one thread.
  void work(const Regions& regions, double begin, double end) override try {
    this->now_ = begin;
    end_ = end;
    zone_ = region_.zone();
    queue_.clear();
    for (const auto& region : regions) queue_.merge(region->deferred[region_.number]);
    this->upcoming_ = Upcoming(queue_.first_taken());
    while (!done_.violated) {
      this->prefetch_upcoming(queue_, [this](Cell cell) { return zone_.may_work_in(cell); });
      const std::uint32_t p = queue_.next([this](std::uint32_t q) { return this->rank(q); });
      if (p == WindowQueue::nothing) break;
      if (!process(p)) done_.violated = true;
    }
  } catch (const PhysicsError&) {
    done_.violated = true;
  }

 private:
  // Returns false if the event may not be processed now.
  bool process(std::uint32_t p) {
    const Event& event = this->gas_.queue[p];
    if (event.time < this->now_ || !may_touch(event.cell, event.time)) return false;
    this->now_ = event.time;
    if (event.face != Event::contact) {
      if (!may_touch(this->gas_.bricks.across(event.cell, event.face), event.time)) return false;
      this->cross(p);
      return true;
    }
    // Another zone may be moving the partner at this moment; then its cell, before and after,
    // belongs to that zone.
    const std::uint32_t q = event.partner;
    const Cell there = this->cell_of_another(q);
    if (this->gas_.bricks.are_neighbours(event.cell, there) &&
        this->gas_.particles[q].changes == event.partner_changes) {
      if (there != event.cell && !may_touch(there, event.time)) return false;
      this->collide(p, q);
    } else {
      this->repredict(p);
    }
    return true;
  }

  bool may_touch(Cell cell, double time) const {
    if (!zone_.may_work_in(cell)) return false;
    // The layer of bricks of the cell has the layer of the cell and one next to it; in the next
    // layer of bricks, one layer of cells is next to the cell.
    const std::uint32_t near = 1 - cell[this->gas_.bricks.last_axis()] % 2;
    float latest = never_marked;
    this->visit_bricks_around(cell, [&](std::size_t, std::uint32_t brick, bool in_next_layer) {
      const float* const marks = &division_.marks[Division::mark_of(brick, 0)];
      latest = std::max(latest, in_next_layer ? marks[near] : std::max(marks[0], marks[1]));
    });
    // Rounding keeps the order of times, but a mark that is rounded to the same number may be
    // later.
    return latest < static_cast<float>(time);
  }

  // ---- the marks of an event ------------------------------------------------------------------

  Events& counts() { return done_.events; }
  void keep(std::uint32_t p) { done_.log.save(p, this->gas_.queue[p]); }
  void touch(Cell) {}  // events in this zone are processed in the order of time
  void meet(std::uint32_t p, std::uint32_t q) { this->meet_for_now(p, q, done_, region_.closest2); }
  void put(std::uint32_t p) {
    if (this->gas_.queue[p].time < end_)
      queue_.add(p);
    else
      this->send(p, region_);
  }

  Region& region_;
  Region::Done& done_ = region_.in(Phase::zone);
  Division& division_;
  Zone zone_;
  double end_ = 0;
  WindowQueue queue_;
};

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
