// SPDX-License-Identifier: GPL-3.0-or-later

// The event loop of several threads: the same events, and the same bits, as that of one.
//
// Time is cut into windows, in each of which one particle in a few hundred has an event. In a
// window, every thread processes the events inside its slab of the box (slab_loop-inl.hpp), then
// those around the border below it (zone_loop-inl.hpp). If two events were processed in the wrong
// order, the window is undone and processed in one piece (one_piece_loop-inl.hpp).
//
// The terms of collisions are added to sums during the next window, in the order of time, as on one
// thread. A run stops at an exact number of collisions: the last few hundred events before the stop
// are processed in one piece.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/parallel/any_loops.hpp"

namespace haff::engine {

class ParallelLoop {
 public:
  ParallelLoop(Gas& gas, LoopMaker& loops, const Threads& threads);

  // Finds the first event of every particle, after a synchronization.
  void predict_all();
  // Runs as EventLoop::run() does.
  void run(std::int64_t collisions, double end);

  const Windows& windows() const { return windows_; }
  std::size_t memory() const;

 private:
  void divide();
  template <class Visit>
  void for_own_part(unsigned thread, const Visit& visit);
  template <class Job>
  void for_each_region(const Job& job);
  void work_until(std::int64_t collisions, double end);
  bool work_window(double end, std::int64_t collisions, double last);
  bool work_in_one_piece(double end, std::int64_t collisions, double last);
  bool stop_at(double last);
  bool is_violated_in(Phase phase) const;
  void undo(double end);
  void adapt(double factor);
  void keep();
  void count_events();
  void add_pending();
  unsigned merge_into_two();

  Gas& gas_;
  Division division_;
  Team& team_;
  Regions regions_;
  std::vector<std::unique_ptr<AnySlabLoop>> slabs_;
  std::vector<std::unique_ptr<AnyZoneLoop>> zones_;
  std::unique_ptr<AnyOnePieceLoop> alone_;
  bool adapts_;
  double window_;    // collisions per particle
  double rate_ = 0;  // collisions per unit of time
  Windows windows_;
  // Collisions of the last window whose terms have not been added to the sums yet, in two lists.
  std::array<Tape<CollisionRecord>, 2> pending_;
  std::atomic<bool> is_pending_ = false;
  std::vector<std::vector<std::uint32_t>> soon_;  // events in each layer, as each thread counts
};

}  // namespace haff::engine
