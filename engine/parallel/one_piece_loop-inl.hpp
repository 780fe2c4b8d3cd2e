// SPDX-License-Identifier: GPL-3.0-or-later

// A stretch of time that one thread processes alone, in the order of all events: a window that had
// to be undone, or the last few hundred events before a run stops.
//
// This file is compiled once for each SIMD target, hence its place in HWY_NAMESPACE.
#if defined(HAFF_ENGINE_ONE_PIECE_LOOP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAFF_ENGINE_ONE_PIECE_LOOP_INL
#undef HAFF_ENGINE_ONE_PIECE_LOOP_INL
#else
#define HAFF_ENGINE_ONE_PIECE_LOOP_INL
#endif

#include <hwy/highway.h>

#include "engine/parallel/any_loops.hpp"
#include "engine/parallel/region_events-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

template <class Search, class Physics>
class OnePieceLoop final : public AnyOnePieceLoop,
                           RegionEvents<OnePieceLoop<Search, Physics>, Search, Physics> {
  using Base = RegionEvents<OnePieceLoop, Search, Physics>;
  friend Base;

 public:
  OnePieceLoop(Gas& gas, Physics& physics, Region& region)
      : Base(gas, physics), region_(region), queue_(&gas.queue[0]) {}

  void begin(double end) override {
    end_ = end;
    queue_.clear();
  }
  void take(std::uint32_t p) override {
    if (this->gas_.queue[p].time < end_)
      queue_.take(p);
    else
      send(p);
  }

  bool work(const Regions& regions, std::int64_t collisions, double last) override {
    for (const auto& region : regions) {
      region->take_mail(regions);
      take_from(region->queue);
    }
    queue_.sort();
    this->now_ = this->gas_.clock.now;
    const bool goes_on = work_queue(collisions, last);
    this->gas_.clock.now = this->now_;
    queue_.for_each([this](std::uint32_t p) { send(p); });
    return goes_on;
  }

 private:
  void take_from(LadderQueueOf<OwnParticles>& queue) {
    for (;;) {
      const std::uint32_t p = queue.next([this](std::uint32_t q) { return this->rank(q); });
      if (p == LadderQueue::nothing) return;
      if (this->gas_.queue[p].time >= end_) {
        queue.put_back();
        return;
      }
      queue_.take(p);
    }
  }

  bool work_queue(std::int64_t collisions, double last) {
    while (this->gas_.clock.collisions < collisions) {
      this->prefetch_upcoming(queue_, [](Cell) { return true; });
      const std::uint32_t p = queue_.next([this](std::uint32_t q) { return this->rank(q); });
      if (p == WindowQueue::nothing) return true;
      const Event& event = this->gas_.queue[p];
      if (event.time > last) {
        queue_.add(p);
        this->now_ = last;
        return false;
      }
      if (event.time < this->now_)
        ++this->gas_.clock.invariants.past_events;
      else
        this->now_ = event.time;
      if (event.face != Event::contact)
        this->cross(p);
      else if (this->gas_.particles[event.partner].changes == event.partner_changes)
        this->collide(p, event.partner);
      else
        this->repredict(p);
    }
    return false;
  }

  void send(std::uint32_t p) { Base::send(p, region_); }

  Events& counts() { return this->gas_.events; }
  void keep(std::uint32_t) {}
  void touch(Cell) {}
  void meet(std::uint32_t p, std::uint32_t q) {
    Gas& gas = this->gas_;
    Particle& a = gas.particles[p];
    Particle& b = gas.particles[q];
    const double since = std::min(a.time, b.time);
    const double approach = this->physics_.collide(a, b, this->now_, gas.box, gas.clock);
    ++gas.clock.collisions;
    if (approach > -slow_approach) {
      gas.clock.now = this->now_;
      note_slow_collision(gas, p, q, since);
    }
  }
  void put(std::uint32_t p) {
    if (this->gas_.queue[p].time < end_)
      queue_.add(p);
    else
      send(p);
  }

  Region& region_;
  double end_ = 0;
  WindowQueue queue_;
};

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
