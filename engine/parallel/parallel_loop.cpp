// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/parallel/parallel_loop.hpp"

#include <algorithm>
#include <cmath>

#include "engine/collision/pair_geometry.hpp"
#include "engine/loop/watchdog.hpp"

namespace haff::engine {
namespace {

// Collisions per particle in the first window, and at most in any window.
constexpr double first_window = 0.003;
constexpr double longest_window = 0.02;
// A window with fewer collisions would not be worthwhile.
constexpr double fewest_collisions = 50;
// Windows become shorter after one that has to be repaired, and longer after others, so that a few
// in a thousand have to be repaired.
constexpr double after_repair = 0.8;
constexpr double after_success = 1.0004;

}  // namespace

ParallelLoop::ParallelLoop(Gas& gas, LoopMaker& loops, const Threads& threads)
    : gas_(gas),
      division_(Slabs::most(gas.bricks, std::max(threads.count, threads.slabs))),
      team_(gas.team),
      adapts_(threads.window <= 0),
      window_(adapts_ ? first_window : threads.window) {
  division_.marks.resize(2 * gas.bricks.count());
  division_.frozen.resize(gas.bricks.count());
  soon_.resize(team_.size());
  for (unsigned k = 0; k < division_.regions; ++k) {
    regions_.push_back(std::make_unique<Region>(gas, division_, k));
    slabs_.push_back(loops.slab_loop(gas, *regions_[k]));
    zones_.push_back(loops.zone_loop(gas, *regions_[k]));
  }
  alone_ = loops.one_piece_loop(gas, *regions_[0]);
}

// Calls the job for every region, each on its own thread.
template <class Job>
void ParallelLoop::for_each_region(const Job& job) {
  team_.run([&](unsigned thread) {
    for (unsigned k = thread; k < division_.regions; k += team_.size()) job(k);
  });
}

// Visits the events of a thread's part of all particles.
template <class Visit>
void ParallelLoop::for_own_part(unsigned thread, const Visit& visit) {
  const std::size_t end = team_.part(gas_.particles.size(), thread + 1);
  for (std::size_t p = team_.part(gas_.particles.size(), thread); p < end; ++p)
    visit(gas_.queue[static_cast<std::uint32_t>(p)]);
}

void ParallelLoop::predict_all() {
  const auto count = static_cast<std::uint32_t>(gas_.particles.size());
  const auto part = [&](unsigned k) {
    return static_cast<std::uint32_t>(std::uint64_t{count} * k / division_.regions);
  };
  for_each_region([&](unsigned k) { slabs_[k]->predict(part(k), part(k + 1)); });
  divide();
  team_.for_parts(division_.marks.size(), [this](std::size_t begin, std::size_t end) {
    std::fill(division_.marks.begin() + static_cast<std::ptrdiff_t>(begin),
              division_.marks.begin() + static_cast<std::ptrdiff_t>(end), never_marked);
  });
  const double rate = gas_.event_rate / division_.regions;
  for_each_region([&](unsigned k) {
    Region& region = *regions_[k];
    region.queue.restart(rate, foresight);
    for (auto& box : region.outbox) box.clear();
    for (std::uint32_t p = 0; p < count; ++p)
      if (gas_.queue[p].owner == k) region.queue.schedule(p);
  });
  rate_ = 0.5 * synchronization_period * count / expected_period(gas_);
}

void ParallelLoop::run(std::int64_t collisions, double end) {
  work_until(collisions, end);
  add_pending();
}

void ParallelLoop::work_until(std::int64_t collisions, double end) {
  while (gas_.clock.collisions < collisions) {
    const auto left = static_cast<double>(collisions - gas_.clock.collisions);
    // With this margin, only one window in 1e9 has more collisions than are left.
    const double most = left - 6 * std::sqrt(left);
    const double window = std::max(window_ * static_cast<double>(gas_.particles.size()),
                                   adapts_ ? fewest_collisions : 1);
    const double until = gas_.clock.now + std::min(window, most) / rate_;
    if (most < fewest_collisions || until >= end) {
      const double piece = std::min(end, gas_.clock.now + 1.2 * (left + 10) / rate_);
      alone_->begin(std::nextafter(piece, never));
      if (!work_in_one_piece(std::nextafter(piece, never), collisions, end)) return;
    } else if (!work_window(until, collisions, end)) {
      return;
    }
  }
}

std::size_t ParallelLoop::memory() const {
  std::size_t bytes = division_.frozen.size() + division_.marks.size() * sizeof(float);
  for (const auto& list : pending_) bytes += list.memory();
  for (const auto& region : regions_) bytes += region->memory();
  return bytes;
}

// Divides the box into slabs for the next period. The work in a layer of cells is the number of its
// particles that soon have an event.
void ParallelLoop::divide() {
  const double soon = 0.02 * expected_period(gas_);
  team_.run([&](unsigned thread) {
    auto& work = soon_[thread];
    work.assign(gas_.bricks.cells(), 0);
    for_own_part(thread, [&](const Event& event) {
      if (event.time < soon) ++work[event.cell[gas_.bricks.last_axis()]];
    });
  });
  std::vector<std::uint32_t> work(gas_.bricks.cells());
  for (const auto& of_thread : soon_)
    for (std::size_t layer = 0; layer < work.size(); ++layer) work[layer] += of_thread[layer];
  division_.slabs.divide(gas_.bricks, work, division_.regions);
  team_.run([&](unsigned thread) {
    for_own_part(thread, [&](Event& event) { event.owner = division_.slabs.slab_of(event.cell); });
  });
}

// Returns false if the run is over.
bool ParallelLoop::work_window(double end, std::int64_t collisions, double last) {
  const double begin = gas_.clock.now;
  ++windows_.count;
  team_.run([&](unsigned thread) {
    for (unsigned k = thread; k < division_.regions; k += team_.size()) {
      regions_[k]->begin_window();
      slabs_[k]->begin_window();
      zones_[k]->begin_window();
      regions_[k]->take_mail(regions_);
      slabs_[k]->work(begin, end);
    }
    add_pending();  // by the first thread that gets here, which has to wait anyway
    team_.wait_for_all();
    if (is_violated_in(Phase::slab)) return;
    for (unsigned k = thread; k < division_.regions; k += team_.size()) {
      zones_[k]->work(regions_, begin, end);
      merge(regions_[k]->in(Phase::slab).collisions, regions_[k]->in(Phase::zone).collisions,
            regions_[k]->ordered);
    }
  });
  const bool violated = is_violated_in(Phase::slab) || is_violated_in(Phase::zone);
  std::int64_t done = 0;
  for (const auto& region : regions_)
    for (const auto& phase : region->done) done += phase.events.collisions;
  if (violated || gas_.clock.collisions + done >= collisions) {
    if (violated) adapt(after_repair);
    ++windows_.repaired;
    undo(end);
    return work_in_one_piece(end, collisions, last);
  }
  adapt(after_success);
  keep();
  rate_ = 0.5 * (rate_ + static_cast<double>(done) / (end - begin));
  gas_.clock.now = end;
  return true;
}

bool ParallelLoop::work_in_one_piece(double end, std::int64_t collisions, double last) {
  const double begin = gas_.clock.now;
  const std::int64_t before = gas_.clock.collisions;
  add_pending();  // before the collisions that follow
  const bool goes_on = alone_->work(regions_, collisions, last);
  const auto done = static_cast<double>(gas_.clock.collisions - before);
  windows_.in_one_piece += gas_.clock.collisions - before;
  if (!goes_on) return false;
  if (end > last) return stop_at(last);
  if (done > 0)
    rate_ = std::max(0.5 * (rate_ + done / (end - begin)), 0.1 * rate_);
  else
    rate_ *= 0.5;
  // No event was left before the end of the window.
  gas_.clock.now = std::max(gas_.clock.now, begin);
  return true;
}

// No event comes before `last`.
bool ParallelLoop::stop_at(double last) {
  bool any = false;
  for (const auto& region : regions_) {
    region->take_mail(regions_);
    if (region->queue.next([](std::uint32_t) { return 0; }) == LadderQueue::nothing) continue;
    region->queue.put_back();
    any = true;
  }
  if (!any) throw PhysicsError("no particle will ever meet another again");
  gas_.clock.now = last;
  return false;
}

bool ParallelLoop::is_violated_in(Phase phase) const {
  return std::any_of(regions_.begin(), regions_.end(),
                     [phase](const auto& region) { return region->in(phase).violated; });
}

// Undoes the whole window, which ends at `end`, and gives its events to one thread.
void ParallelLoop::undo(double end) {
  for (const auto& zone : zones_) zone->undo_collisions();
  for (const auto& slab : slabs_) slab->undo_collisions();
  for (const Phase phase : {Phase::zone, Phase::slab})
    for (const auto& region : regions_)
      region->in(phase).log.undo(
          [this](std::uint32_t p, const Event& before) {
            Event& event = gas_.queue[p];
            if (event.cell != before.cell) gas_.bricks.move(p, event.cell, before.cell);
            event = before;
          },
          [this](std::uint32_t p, const Particle& before) { gas_.particles[p] = before; });
  alone_->begin(end);
  for (const auto& region : regions_) {
    for (const auto& phase : region->done)
      phase.log.for_each_particle([this](std::uint32_t p) { alone_->take(p); });
    for (const auto& list : region->deferred)
      for (const auto& entry : list) alone_->take(entry.particle);
  }
}

void ParallelLoop::adapt(double factor) {
  if (adapts_) window_ = std::min(window_ * factor, longest_window);
}

void ParallelLoop::count_events() {
  for (const Phase phase : {Phase::slab, Phase::zone}) {
    std::int64_t longest = 0;
    for (const auto& region : regions_) {
      const Events& events = region->in(phase).events;
      const std::int64_t count = events.collisions + events.crossings + events.stale;
      longest = std::max(longest, count);
      (phase == Phase::slab ? windows_.in_slabs : windows_.in_zones) += count;
      gas_.events.collisions += events.collisions;
      gas_.events.crossings += events.crossings;
      gas_.events.stale += events.stale;
      gas_.clock.collisions += events.collisions;
    }
    windows_.longest += longest;
  }
}

// Keeps the changes of the window beside the particles.
void ParallelLoop::keep() {
  count_events();
  for (const auto& region : regions_)
    gas_.clock.invariants.closest2 = std::min(gas_.clock.invariants.closest2, region->closest2);
  const unsigned half = merge_into_two();
  pending_[0].swap(regions_[0]->ordered);
  pending_[1].swap(regions_[half]->ordered);
  is_pending_.store(true, std::memory_order_relaxed);
}

// Adds the terms that the last window has left to the sums. One thread does this, while others may
// already work on the next window.
void ParallelLoop::add_pending() {
  if (!is_pending_.exchange(false, std::memory_order_relaxed)) return;
  Tally tally = gas_.clock.tally;
  visit_in_order(pending_[0], pending_[1], [&tally](const CollisionRecord& collision) {
    tally.virial += collision.virial;
    tally.dissipated += collision.dissipated[0];
    tally.dissipated += collision.dissipated[1];
  });
  gas_.clock.tally = tally;
}

// Merges the lists of collisions, in pairs and all pairs at once, until two are left: that of the
// first region, and that of the region that is returned.
unsigned ParallelLoop::merge_into_two() {
  unsigned step = 1;
  for (; 2 * step < division_.regions; step *= 2)
    team_.run([&](unsigned thread) {
      for (unsigned pair = thread; 2 * step * pair + step < division_.regions;
           pair += team_.size()) {
        Region& first = *regions_[2 * step * pair];
        merge(first.ordered, regions_[2 * step * pair + step]->ordered, first.merged);
        first.ordered.swap(first.merged);
      }
    });
  return step;
}

}  // namespace haff::engine
