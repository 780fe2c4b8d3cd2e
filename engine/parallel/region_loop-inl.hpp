// The events of one region of the box within one window of time, worked off by one thread.
//
// Within a window three phases follow each other: every slab, then every zone around a border
// between two slabs, then the whole box. An event is processed in the first phase in which it has
// everything that it reads to itself; otherwise it is deferred to the next phase, and what is
// around it is frozen until then, because the event may change it.
//
// Why the result does not depend on the division. Suppose that an event X, which is earlier than an
// event Y, was processed after Y. If neither reads a cell in which the other one changes something,
// the order of the two is immaterial. If one does, then a cell of a particle of Y is next to (or
// the same as) a cell of a particle of X, since an event reads the cells next to those of its
// particles and changes only these. Every event leaves its time as a mark on the bricks of its
// particles, and X finds the mark of Y, which is later than its own time, in the bricks that it
// reads. So this is always noticed: the window is undone and worked off in one piece.
//
// This file is compiled once for each SIMD target, hence its place in HWY_NAMESPACE.
#if defined(HAFF_ENGINE_REGION_LOOP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAFF_ENGINE_REGION_LOOP_INL
#undef HAFF_ENGINE_REGION_LOOP_INL
#else
#define HAFF_ENGINE_REGION_LOOP_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>

#include "engine/loop/watchdog.hpp"
#include "engine/parallel/division.hpp"
#include "engine/parallel/window_log.hpp"
#include "engine/search/plain_search.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

template <class Search, class Physics, int dimension, bool prefetching>
class RegionLoop {
 public:
  RegionLoop(Gas& gas, Physics& physics, Division& division, unsigned number)
      : gas_(gas),
        physics_(physics),
        division_(division),
        number_(number),
        search_(gas, physics),
        queue_(&gas.queue[0], static_cast<std::uint32_t>(gas.particles.size()) / division.regions),
        deferred_(division.regions + 1),
        outbox_(division.regions) {}

  // ---- a period -------------------------------------------------------------------------------

  // After a synchronization: the first event of each of the region's own particles.
  void begin_period(double rate) {
    queue_.restart(rate, prefetching ? foresight : 0);
    for (auto& box : outbox_) box.clear();
    phase_ = Phase::slab;
    now_ = 0;
    for (std::uint32_t p = 0; p < gas_.particles.size(); ++p)
      if (is_own(p)) set_prediction(p, search_.around_higher(p, gas_.queue[p].cell));
  }

  // ---- a window -------------------------------------------------------------------------------

  void begin_window(double begin, double end) {
    begin_ = begin;
    end_ = end;
    violated_ = false;
    events_ = {};
    closest2_ = 1;
    for (auto& log : logs_) log.clear();
    for (auto& list : collisions_) list.clear();
    for (auto& list : deferred_) list.clear();
  }

  // The events of the region's own particles inside its slab.
  template <class Regions>
  void work_slab(const Regions& regions) {
    begin_phase(Phase::slab, division_.slabs.slab(number_));
    take_mail(regions);
    while (!violated_) {
      const std::uint32_t p = queue_.next([this](std::uint32_t q) { return rank(q); });
      if (p == LadderQueue::nothing) break;
      if (!is_own(p)) continue;
      if (gas_.queue[p].time >= end_) {
        queue_.put_back();
        break;
      }
      if constexpr (prefetching) prefetch_upcoming();
      process(p);
    }
    thaw();
  }

  // The events that were deferred in the slabs, around the border below this one.
  template <class Regions>
  void work_zone(const Regions& regions) {
    begin_phase(Phase::zone, division_.slabs.zone(number_));
    for (const auto& region : regions)
      for (const std::uint32_t p : region->deferred_[number_]) push(p);
    work_heap();
    thaw();
  }

  // The events that were deferred in the zones.
  template <class Regions>
  void work_box(const Regions& regions) {
    begin_phase(Phase::box, Territory());
    for (const auto& region : regions)
      for (const std::uint32_t p : region->deferred_.back()) push(p);
    work_heap();
  }

  bool violated() const { return violated_; }
  const Events& events() const { return events_; }
  double closest2() const { return closest2_; }
  std::int64_t events_in(Phase phase) const { return processed_[static_cast<std::size_t>(phase)]; }
  std::vector<CollisionRecord>& collisions_in(Phase phase) {
    return collisions_[static_cast<std::size_t>(phase)];
  }

  // Undoes what this region did in a phase. The phases of all regions are undone in reverse order.
  void undo(Phase phase) {
    logs_[static_cast<std::size_t>(phase)].undo(
        [this](std::uint32_t p, const Event& before) {
          Event& event = gas_.queue[p];
          if (event.cell != before.cell) gas_.bricks.move(p, event.cell, before.cell);
          event = before;
        },
        [this](std::uint32_t p, const Particle& before) { gas_.particles[p] = before; },
        [this](const typename Physics::Memento& before) { physics_.restore(before); });
  }

  // ---- in one piece ---------------------------------------------------------------------------

  // Works off all events before `end` in their order, as the event loop of one thread does, until
  // the given total number of collisions. Returns false if the run is over: the number is reached,
  // or the next event is later than `last`.
  template <class Regions>
  bool work_in_one_piece(const Regions& regions, double end, std::int64_t collisions, double last) {
    phase_ = Phase::box;
    territory_ = Territory();
    end_ = end;
    now_ = gas_.clock.now;
    for (const auto& region : regions) region->hand_over(regions, *this);
    const bool goes_on = work_exactly(collisions, last);
    gas_.clock.now = now_;
    for (const auto& [time, p] : heap_)
      if (gas_.queue[p].time == time) send(p);
    heap_.clear();
    return goes_on;
  }

  // After undo(): the particles that this region touched or deferred have their events to come
  // again.
  void return_events(RegionLoop& to) {
    for (auto& log : logs_) log.for_each_event([&](std::uint32_t p) { to.push_or_send(p); });
    for (auto& list : deferred_)
      for (const std::uint32_t p : list) to.push_or_send(p);
  }
  void prepare_to_redo(double end) {
    end_ = end;
    phase_ = Phase::box;
    heap_.clear();
  }
  // Whether there is any event at all, however late.
  bool has_events() {
    for (;;) {
      const std::uint32_t p = queue_.next([this](std::uint32_t q) { return rank(q); });
      if (p == LadderQueue::nothing) return false;
      if (!is_own(p)) continue;
      queue_.put_back();
      return true;
    }
  }

  std::size_t memory() const {
    std::size_t bytes = queue_.memory();
    for (const auto& log : logs_) bytes += log.memory();
    for (const auto& list : collisions_) bytes += list.capacity() * sizeof(CollisionRecord);
    for (const auto& list : deferred_) bytes += list.capacity() * sizeof(std::uint32_t);
    for (const auto& list : outbox_) bytes += list.capacity() * sizeof(std::uint32_t);
    return bytes;
  }

 private:
  enum class Access { granted, deferred, violated };
  static constexpr std::uint64_t frozen = std::uint64_t{1} << 63;

  bool is_own(std::uint32_t p) const { return division_.owner[p] == number_; }

  void begin_phase(Phase phase, const Territory& territory) {
    phase_ = phase;
    territory_ = territory;
    now_ = begin_;
    processed_[static_cast<std::size_t>(phase)] = 0;
    heap_.clear();
  }

  template <class Regions>
  void take_mail(const Regions& regions) {
    for (const auto& region : regions) {
      for (const std::uint32_t p : region->outbox_[number_]) queue_.schedule(p);
      region->outbox_[number_].clear();
    }
  }

  // Gives all events before the end of `to`'s window to `to`.
  template <class Regions>
  void hand_over(const Regions& regions, RegionLoop& to) {
    take_mail(regions);
    for (;;) {
      const std::uint32_t p = queue_.next([this](std::uint32_t q) { return rank(q); });
      if (p == LadderQueue::nothing) return;
      if (!is_own(p)) continue;
      if (gas_.queue[p].time >= to.end_) {
        queue_.put_back();
        return;
      }
      to.push(p);
    }
  }

  // ---- which event is next --------------------------------------------------------------------

  struct Entry {
    double time;
    std::uint32_t particle;
  };
  static bool later(const Entry& a, const Entry& b) { return a.time > b.time; }

  void push(std::uint32_t p) {
    heap_.push_back({gas_.queue[p].time, p});
    std::push_heap(heap_.begin(), heap_.end(), later);
  }
  Entry pop() {
    std::pop_heap(heap_.begin(), heap_.end(), later);
    const Entry entry = heap_.back();
    heap_.pop_back();
    return entry;
  }
  // To the queue of the slab that the particle is in.
  void send(std::uint32_t p) {
    const unsigned owner = division_.slabs.slab_of_layer(gas_.bricks.layer_of(gas_.queue[p].cell));
    division_.owner[p] = static_cast<std::uint8_t>(owner);
    outbox_[owner].push_back(p);
  }
  void push_or_send(std::uint32_t p) {
    if (gas_.queue[p].time < end_)
      push(p);
    else
      send(p);
  }

  // The particle whose event is first in the heap, by (time, rank); LadderQueue::nothing if none
  // is.
  std::uint32_t next_in_heap() {
    while (!heap_.empty()) {
      const Entry first = pop();
      if (gas_.queue[first.particle].time != first.time) continue;  // outdated
      if (heap_.empty() || heap_.front().time != first.time) return first.particle;
      std::vector<std::uint32_t> tied{first.particle};
      while (!heap_.empty() && heap_.front().time == first.time)
        if (const Entry other = pop(); gas_.queue[other.particle].time == other.time)
          tied.push_back(other.particle);
      const auto least =
          std::min_element(tied.begin(), tied.end(),
                           [this](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
      const std::uint32_t p = *least;
      for (const std::uint32_t other : tied)
        if (other != p) push(other);
      return p;
    }
    return LadderQueue::nothing;
  }

  void work_heap() {
    while (!violated_) {
      const std::uint32_t p = next_in_heap();
      if (p == LadderQueue::nothing) return;
      process(p);
    }
  }

  bool work_exactly(std::int64_t collisions, double last) {
    while (gas_.clock.collisions < collisions) {
      const std::uint32_t p = next_in_heap();
      if (p == LadderQueue::nothing) return true;
      const Event& event = gas_.queue[p];
      if (event.time > last) {
        push(p);
        now_ = last;
        return false;
      }
      if (event.time < now_)
        ++gas_.clock.invariants.past_events;
      else
        now_ = event.time;
      if (event.face != Event::contact)
        cross<true>(p);
      else if (gas_.particles[event.partner].changes == event.partner_changes)
        collide<true>(p, event.partner);
      else
        repredict<true>(p);
    }
    return false;
  }

  // ---- one event ------------------------------------------------------------------------------

  // An exception is a matter for the event loop of one thread, too.
  void process(std::uint32_t p) try {
    const Event& event = gas_.queue[p];
    limit_ = std::bit_cast<std::uint64_t>(event.time) + slack();
    switch (access(event)) {
      case Access::deferred:
        defer(p);
        return;
      case Access::violated:
        violated_ = true;
        return;
      case Access::granted:
        break;
    }
    if (event.time < now_) {  // rounding: only the loop of one thread knows what `now` is then
      violated_ = true;
      return;
    }
    now_ = event.time;
    ++processed_[static_cast<std::size_t>(phase_)];
    if (event.face != Event::contact)
      cross<false>(p);
    else if (gas_.particles[event.partner].changes == event.partner_changes)
      collide<false>(p, event.partner);
    else
      repredict<false>(p);
  } catch (const PhysicsError&) {
    violated_ = true;
  }

  // The marks of an earlier phase count as later than an event of exactly the same time: which of
  // the two is first is not known here.
  std::uint64_t slack() const { return 2 - static_cast<std::uint64_t>(phase_); }

  // May the event be processed in this phase?
  Access access(const Event& event) const {
    const Access here = access(event.cell);
    if (here != Access::granted) return here;
    if (event.face != Event::contact) return access(gas_.bricks.across(event.cell, event.face));
    if (phase_ == Phase::slab && !is_own(event.partner)) return Access::deferred;
    const Cell there = cell_of(event.partner);
    return there == event.cell ? here : access(there);
  }
  Access access(Cell cell) const {
    if (!territory_.holds(cell)) return Access::deferred;
    const std::uint64_t* const marks = division_.marks.data();
    std::uint64_t latest = 0;
    for (const std::uint32_t brick : gas_.bricks.template around<dimension>(cell).brick)
      latest = std::max(latest, marks[brick / Bricks::slots]);
    if (latest <= limit_) [[likely]]
      return Access::granted;
    return latest >= frozen ? Access::deferred : Access::violated;
  }

  // Another zone may just be moving the particle; then its cell, before and after, belongs to that
  // zone.
  Cell cell_of(std::uint32_t p) const {
    return {std::atomic_ref(gas_.queue[p].cell.packed).load(std::memory_order_relaxed)};
  }
  void set_cell(std::uint32_t p, Cell cell) {
    std::atomic_ref(gas_.queue[p].cell.packed).store(cell.packed, std::memory_order_relaxed);
  }

  void mark(Cell cell) { division_.marks[gas_.bricks.brick_of(cell) / Bricks::slots] = limit_; }

  void defer(std::uint32_t p) {
    const Event& event = gas_.queue[p];
    deferred_[phase_ == Phase::slab
                  ? division_.slabs.zone_of_layer(gas_.bricks.layer_of(event.cell))
                  : division_.regions]
        .push_back(p);
    freeze(event.cell);
    if (event.face != Event::contact)
      freeze(gas_.bricks.across(event.cell, event.face));
    else if (phase_ != Phase::slab || is_own(event.partner))
      freeze(cell_of(event.partner));
    else
      freeze_widely(event.cell);
  }

  // Freezes the bricks around a cell, those in the own territory.
  void freeze(Cell cell) {
    const auto bricks = gas_.bricks.template around<dimension>(cell).brick;
    const std::uint32_t layers = gas_.bricks.layers();
    const std::uint32_t own = gas_.bricks.layer_of(cell);
    const std::uint32_t next =
        (own + (cell[gas_.bricks.last_axis()] % 2 == 1 ? 1 : layers - 1)) % layers;
    // The first half of the bricks is in the layer of the cell, the second half in the next one.
    for (std::size_t n = 0; n < bricks.size(); ++n) {
      if (!territory_.holds_layer(n < bricks.size() / 2 ? own : next)) continue;
      std::uint64_t& mark = division_.marks[bricks[n] / Bricks::slots];
      if (mark >= frozen) continue;
      mark |= frozen;
      frozen_.push_back(bricks[n]);
    }
  }
  // The partner belongs to another region, and its cell, next to this one, is not known here.
  void freeze_widely(Cell cell) {
    for (Face corner = 0; corner < 1u << dimension; ++corner) {
      Cell at = cell;
      for (Face axis = 0; axis < dimension; ++axis)
        at = gas_.bricks.across(at, 2 * axis + (corner >> axis & 1));
      freeze(at);
    }
  }
  void thaw() {
    for (const std::uint32_t brick : frozen_) division_.marks[brick / Bricks::slots] &= ~frozen;
    frozen_.clear();
  }

  // `exactly`: as the event loop of one thread, without a log.
  template <bool exactly>
  void collide(std::uint32_t p, std::uint32_t q) {
    Particle& a = gas_.particles[p];
    Particle& b = gas_.particles[q];
    const Cell p_cell = gas_.queue[p].cell;
    const Cell q_cell = gas_.queue[q].cell;
    if constexpr (exactly) {
      const double since = std::min(a.time, b.time);
      const double approach = physics_.collide(a, b, now_, gas_.box, gas_.clock);
      ++gas_.clock.collisions;
      ++gas_.events.collisions;
      if (approach > -slow_approach) {
        gas_.clock.now = now_;
        note_slow_collision(gas_, p, q, since);
      }
    } else {
      auto& log = logs_[static_cast<std::size_t>(phase_)];
      log.save(p, gas_.queue[p]);
      log.save(q, gas_.queue[q]);
      log.save(p, a);
      log.save(q, b);
      log.save(physics_.memento(a, b));
      CollisionTerms terms;
      const double approach = physics_.collide(a, b, now_, gas_.box, terms);
      if (approach > -slow_approach) violated_ = true;  // for the watchdog
      closest2_ = std::min(closest2_, terms.invariants.closest2);
      const auto& lost = terms.tally.dissipated.value;
      collisions_in(phase_).push_back(
          {now_, rank_of(a, b), terms.tally.virial.value[0], {lost[0], lost[1]}});
      ++events_.collisions;
      mark(p_cell);
      mark(q_cell);
    }
    if (phase_ == Phase::slab) queue_.forget(q);
    const auto [first, second] = search_.around_both(p, p_cell, q, q_cell);
    set_prediction(p, first);
    set_prediction(q, second);
  }

  template <bool exactly>
  void cross(std::uint32_t p) {
    Event& event = gas_.queue[p];
    if constexpr (!exactly) {
      logs_[static_cast<std::size_t>(phase_)].save(p, event);
      mark(event.cell);
    }
    ++(exactly ? gas_.events : events_).crossings;
    set_cell(p, gas_.bricks.cross(p, event.cell, event.face));
    if constexpr (!exactly) mark(event.cell);
    const Contact contact = search_.beyond(p, event.cell, event.face, now_);
    if (contact.time < never) {
      const Contact known{event.contact_time, event.partner};
      if (engine::comes_before(contact, known, gas_.particles)) {
        event.contact_time = contact.time;
        event.partner = contact.partner;
        event.partner_changes = gas_.particles[contact.partner].changes;
      }
    }
    schedule(p);
  }

  template <bool exactly>
  void repredict(std::uint32_t p) {
    const Cell cell = gas_.queue[p].cell;
    if constexpr (!exactly) {
      logs_[static_cast<std::size_t>(phase_)].save(p, gas_.queue[p]);
      mark(cell);
    }
    ++(exactly ? gas_.events : events_).stale;
    set_prediction(p, search_.around(p, cell, now_));
  }

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
    std::atomic_ref(event.time)
        .store(std::min(event.contact_time, exit.time), std::memory_order_relaxed);
    event.face = choose(event.contact_time <= exit.time, Event::contact, exit.face);
    if (phase_ == Phase::slab)
      queue_.schedule(p);
    else
      push_or_send(p);
  }

  std::uint64_t rank(std::uint32_t p) const {
    const Event& event = gas_.queue[p];
    if (event.face != Event::contact) return 0;
    return rank_of(gas_.particles[p], gas_.particles[event.partner]);
  }
  static std::uint64_t rank_of(const Particle& a, const Particle& b) {
    return 1 + (std::uint64_t{std::min(a.id, b.id)} << 32 | std::max(a.id, b.id));
  }

  // As in the event loop of one thread, but it looks only at what belongs to the region.
  HWY_INLINE void prefetch_upcoming() {
    {
      const std::uint32_t p = queue_.coming(4 * stride);
      __builtin_prefetch(gas_.particles.data() + p, 1, 2);
      __builtin_prefetch(&gas_.queue[p], 1, 2);
      __builtin_prefetch(&division_.owner[p], 0, 2);
    }
    if (const std::uint32_t p = queue_.coming(3 * stride); is_inside(p)) {
      const Event& event = gas_.queue[p];
      prefetch_marks(event.cell);
      if (event.face == Event::contact) {
        __builtin_prefetch(gas_.particles.data() + event.partner, 1, 2);
        __builtin_prefetch(&gas_.queue[event.partner], 1, 2);
        __builtin_prefetch(&division_.owner[event.partner], 0, 2);
        search_.prefetch_bricks_around(event.cell);
      } else {
        search_.prefetch_bricks_beyond(event.cell, event.face);
      }
    }
    if (const std::uint32_t p = queue_.coming(2 * stride); is_inside(p)) {
      const Event& event = gas_.queue[p];
      if (event.face == Event::contact) {
        search_.prefetch_particles_around(event.cell);
        if (is_inside(event.partner) && gas_.queue[event.partner].cell != event.cell)
          search_.prefetch_bricks_around(gas_.queue[event.partner].cell);
      } else if (territory_.holds(gas_.bricks.across(event.cell, event.face))) {
        search_.prefetch_particles_beyond(event.cell, event.face);
      }
    }
    if (!huge_) return;
    if (const std::uint32_t p = queue_.coming(stride); is_inside(p)) {
      const Event& event = gas_.queue[p];
      if (event.face == Event::contact && is_inside(event.partner) &&
          gas_.queue[event.partner].cell != event.cell)
        search_.prefetch_particles_around(gas_.queue[event.partner].cell);
    }
  }
  bool is_inside(std::uint32_t p) const {
    return is_own(p) && territory_.holds(gas_.queue[p].cell);
  }
  HWY_INLINE void prefetch_marks(Cell cell) {
    const auto bricks = gas_.bricks.template around<dimension>(cell).brick;
    for (std::size_t n = 0; n < bricks.size(); n += 2)
      __builtin_prefetch(&division_.marks[bricks[n] / Bricks::slots], 1, 2);
  }

  static constexpr std::uint32_t stride = foresight / 4;

  Gas& gas_;
  Physics& physics_;
  Division& division_;
  unsigned number_;
  const bool huge_ = gas_.particles.size() > 200000;
  Search search_;
  LadderQueue queue_;  // of the region's own particles

  double begin_ = 0, end_ = 0;  // of the window
  Phase phase_ = Phase::slab;
  Territory territory_;
  double now_ = 0;
  std::uint64_t limit_ = 0;  // the latest mark that the present event may find
  bool violated_ = false;

  std::vector<Entry> heap_;                           // events of a zone or of the box
  std::vector<std::vector<std::uint32_t>> deferred_;  // to each zone; the last one to the box
  std::vector<std::vector<std::uint32_t>> outbox_;    // events after the window, by owner
  std::vector<std::uint32_t> frozen_;                 // bricks

  std::array<UndoLog<typename Physics::Memento>, phases> logs_;
  std::array<std::vector<CollisionRecord>, phases> collisions_;
  std::array<std::int64_t, phases> processed_{};
  Events events_;
  double closest2_ = 1;
};

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
