// SPDX-License-Identifier: GPL-3.0-or-later

// The interface of the loops over the events of a region. The loops themselves are compiled for
// each physics and each SIMD target; the parallel loop, which calls them, is compiled once.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/parallel/region.hpp"

namespace haff::engine {

using Regions = std::vector<std::unique_ptr<Region>>;

// A loop whose collisions may have to be undone.
class UndoableLoop {
 public:
  virtual ~UndoableLoop() = default;
  virtual void begin_window() = 0;
  // Restores the data beside the particles' records that collisions have changed in this window.
  virtual void undo_collisions() = 0;
};

class AnySlabLoop : public UndoableLoop {
 public:
  // Finds the first contacts of a part of all particles, after a synchronization.
  virtual void predict(std::uint32_t begin, std::uint32_t end) = 0;
  // Processes the events from `begin` to `end`.
  virtual void work(double begin, double end) = 0;
};

class AnyZoneLoop : public UndoableLoop {
 public:
  // Processes the events that all regions have deferred to this zone, from `begin` to `end`.
  virtual void work(const Regions& regions, double begin, double end) = 0;
};

class AnyOnePieceLoop {
 public:
  virtual ~AnyOnePieceLoop() = default;
  // Begins a stretch up to `end`. Takes over the particles whose events come until then; the events
  // of others are sent to their slabs.
  virtual void begin(double end) = 0;
  virtual void take(std::uint32_t p) = 0;
  // Processes the events in their order, as the event loop of one thread does, until the given
  // total number of collisions. Returns false if the run is over: the number is reached, or the
  // next event is later than `last`.
  virtual bool work(const Regions& regions, std::int64_t collisions, double last) = 0;
};

// Makes the loops of a physics.
class LoopMaker {
 public:
  virtual ~LoopMaker() = default;
  virtual std::unique_ptr<AnySlabLoop> slab_loop(Gas& gas, Region& region) = 0;
  virtual std::unique_ptr<AnyZoneLoop> zone_loop(Gas& gas, Region& region) = 0;
  // `region`: a region that may send particles to all others.
  virtual std::unique_ptr<AnyOnePieceLoop> one_piece_loop(Gas& gas, Region& region) = 0;
};

}  // namespace haff::engine
