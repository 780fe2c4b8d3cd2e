// The event loop of several threads: the same events, and the same bits, as that of one.
//
// Time is cut into windows, in each of which one event in a few hundred happens to a particle. In a
// window, every thread works off the events inside its slab of the box, then those around the
// border below it, and one thread does what is left (region_loop-inl.hpp). If two events were
// processed in the wrong order, the window is undone and worked off in one piece.
//
// What collisions add to sums is added up after the window, in the order of time, as one thread
// does it. A run stops at an exact number of collisions: the last few hundred events before it are
// worked off in one piece.
//
// This file is compiled once for each SIMD target, hence its place in HWY_NAMESPACE.
#if defined(HAFF_ENGINE_PARALLEL_LOOP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAFF_ENGINE_PARALLEL_LOOP_INL
#undef HAFF_ENGINE_PARALLEL_LOOP_INL
#else
#define HAFF_ENGINE_PARALLEL_LOOP_INL
#endif

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "engine/parallel/region_loop-inl.hpp"
#include "engine/parallel/team.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

template <class Search, class Physics, int dimension, bool prefetching>
class ParallelLoop {
 public:
  ParallelLoop(Gas& gas, Physics& physics, const Threads& threads)
      : gas_(gas),
        physics_(physics),
        division_(Slabs::most(gas.bricks, std::max(threads.count, threads.slabs))),
        team_(std::clamp(threads.count, 1u, division_.regions)),
        adapts_(threads.window <= 0),
        window_(adapts_ ? first_window : threads.window) {
    division_.owner.resize(gas.particles.size());
    division_.marks.resize(gas.bricks.count());
    for (unsigned k = 0; k < division_.regions; ++k)
      regions_.push_back(std::make_unique<Region>(gas, physics, division_, k));
  }

  // Finds the first event of every particle, after a synchronization.
  void predict_all() {
    const std::span<const Event> events(&gas_.queue[0], gas_.particles.size());
    division_.slabs.divide(gas_.bricks, events, division_.regions);
    for (std::size_t p = 0; p < events.size(); ++p)
      division_.owner[p] = static_cast<std::uint8_t>(
          division_.slabs.slab_of_layer(gas_.bricks.layer_of(events[p].cell)));
    std::fill(division_.marks.begin(), division_.marks.end(), 0);
    const double rate = events_per_time(gas_) / division_.regions;
    for_each_region([&](Region& region) { region.begin_period(rate); });
    rate_ = 0.5 * synchronization_period * static_cast<double>(gas_.particles.size()) /
            expected_period(gas_);
  }

  // As EventLoop::run().
  void run(std::int64_t collisions, double end) {
    while (gas_.clock.collisions < collisions) {
      const auto left = static_cast<double>(collisions - gas_.clock.collisions);
      // With this margin, a window has more collisions than are left once in 1e9 times.
      const double most = left - 6 * std::sqrt(left);
      const double window =
          std::max(window_ * static_cast<double>(gas_.particles.size()), fewest_collisions);
      const double until = gas_.clock.now + std::min(window, most) / rate_;
      if (most < fewest_collisions || until >= end) {
        const double piece = std::min(end, gas_.clock.now + 1.2 * (left + 10) / rate_);
        if (!work_in_one_piece(std::nextafter(piece, never), collisions, end)) return;
      } else if (!work_window(until, collisions, end)) {
        return;
      }
    }
  }

  const Windows& windows() const { return windows_; }
  std::size_t memory() const {
    std::size_t bytes = division_.owner.size() + division_.marks.size() * sizeof(std::uint64_t);
    for (const auto& region : regions_) bytes += region->memory();
    return bytes + (sorted_.capacity() + merged_.capacity()) * sizeof(CollisionRecord);
  }

 private:
  using Region = RegionLoop<Search, Physics, dimension, prefetching>;

  // Collisions per particle in a window, to begin with, and at most.
  static constexpr double first_window = 0.005;
  static constexpr double longest_window = 0.02;
  // Fewer collisions are not worth a window.
  static constexpr double fewest_collisions = 100;

  // Returns false if the run is over.
  bool work_window(double end, std::int64_t collisions, double last) {
    const double begin = gas_.clock.now;
    ++windows_.count;
    for_each_region([&](Region& region) {
      region.begin_window(begin, end);
      region.work_slab(regions_);
    });
    bool violated = is_violated();
    if (!violated) {
      for_each_region([&](Region& region) { region.work_zone(regions_); });
      violated = is_violated();
    }
    if (!violated) {
      regions_[0]->work_box(regions_);
      violated = is_violated();
    }
    std::int64_t done = 0;
    for (const auto& region : regions_) done += region->events().collisions;
    if (violated || gas_.clock.collisions + done >= collisions) {
      if (violated) adapt(0.7);
      ++windows_.repaired;
      undo();
      regions_[0]->prepare_to_redo(end);
      for (const auto& region : regions_) region->return_events(*regions_[0]);
      return work_in_one_piece(end, collisions, last);
    }
    adapt(1.003);
    keep();
    rate_ = 0.5 * (rate_ + static_cast<double>(done) / (end - begin));
    gas_.clock.now = end;
    return true;
  }

  bool work_in_one_piece(double end, std::int64_t collisions, double last) {
    const double begin = gas_.clock.now;
    const std::int64_t before = gas_.clock.collisions;
    const bool goes_on = regions_[0]->work_in_one_piece(regions_, end, collisions, last);
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
  bool stop_at(double last) {
    const bool any = std::any_of(regions_.begin(), regions_.end(),
                                 [](const auto& region) { return region->has_events(); });
    if (!any) throw PhysicsError("no particle will ever meet another again");
    gas_.clock.now = last;
    return false;
  }

  template <class Job>
  void for_each_region(const Job& job) {
    team_.run([&](unsigned thread) {
      for (unsigned k = thread; k < division_.regions; k += team_.size()) job(*regions_[k]);
    });
  }

  bool is_violated() const {
    return std::any_of(regions_.begin(), regions_.end(),
                       [](const auto& region) { return region->violated(); });
  }

  void undo() {
    for (const Phase phase : {Phase::box, Phase::zone, Phase::slab})
      for (const auto& region : regions_) region->undo(phase);
  }

  void adapt(double factor) {
    if (adapts_) window_ = std::min(window_ * factor, longest_window);
  }

  void count_events() {
    std::int64_t longest_slab = 0, longest_zone = 0;
    for (const auto& region : regions_) {
      longest_slab = std::max(longest_slab, region->events_in(Phase::slab));
      longest_zone = std::max(longest_zone, region->events_in(Phase::zone));
      windows_.in_slabs += region->events_in(Phase::slab);
      windows_.in_zones += region->events_in(Phase::zone);
    }
    const std::int64_t in_box = regions_[0]->events_in(Phase::box);
    windows_.in_box += in_box;
    windows_.longest += longest_slab + longest_zone + in_box;
  }

  // All collisions of the window in the order of time, in sorted_.
  void sort_collisions() {
    std::vector<std::vector<CollisionRecord>*> lists;
    for (const Phase phase : {Phase::slab, Phase::zone, Phase::box})
      for (const auto& region : regions_)
        if (auto& list = region->collisions_in(phase); !list.empty()) lists.push_back(&list);
    // The shortest first.
    sorted_.clear();
    std::sort(lists.begin(), lists.end(),
              [](const auto* a, const auto* b) { return a->size() < b->size(); });
    for (auto* list : lists) {
      merged_.resize(sorted_.size() + list->size());
      std::merge(sorted_.begin(), sorted_.end(), list->begin(), list->end(), merged_.begin(),
                 [](const auto& a, const auto& b) { return engine::comes_before(a, b); });
      sorted_.swap(merged_);
    }
  }

  // What the window has changed beside the particles.
  void keep() {
    for (const auto& region : regions_) {
      gas_.events.collisions += region->events().collisions;
      gas_.events.crossings += region->events().crossings;
      gas_.events.stale += region->events().stale;
      gas_.clock.collisions += region->events().collisions;
      gas_.clock.invariants.closest2 = std::min(gas_.clock.invariants.closest2, region->closest2());
    }
    count_events();
    sort_collisions();
    for (const CollisionRecord& collision : sorted_) {
      gas_.clock.tally.virial += collision.virial;
      gas_.clock.tally.dissipated += collision.dissipated[0];
      gas_.clock.tally.dissipated += collision.dissipated[1];
    }
  }

  Gas& gas_;
  Physics& physics_;
  Division division_;
  Team team_;
  std::vector<std::unique_ptr<Region>> regions_;
  bool adapts_;
  double window_;    // collisions per particle
  double rate_ = 0;  // collisions per unit of time
  Windows windows_;
  std::vector<CollisionRecord> sorted_, merged_;
};

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
