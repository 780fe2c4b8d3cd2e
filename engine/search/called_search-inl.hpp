// SPDX-License-Identifier: GPL-3.0-or-later

// The SIMD search as functions that are called rather than inlined, for spheres and disks.
//
// An event loop that inlines the search has a dozen copies of it, for which the compiler takes a
// second or more, for every physics, dimension and SIMD target. That saves 3 % of the instructions
// of a gas on one thread; the loops of several threads, and those that count collisions, share one
// copy for each pair geometry.
//
// This file is compiled once for each SIMD target, hence its place in HWY_NAMESPACE.
#if defined(HAFF_ENGINE_CALLED_SEARCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAFF_ENGINE_CALLED_SEARCH_INL
#undef HAFF_ENGINE_CALLED_SEARCH_INL
#else
#define HAFF_ENGINE_CALLED_SEARCH_INL
#endif

#include <hwy/highway.h>

#include <utility>

#include "engine/search/simd_search-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

template <class PairGeometry = HardSpheres>
class CalledSearch {
 public:
  CalledSearch(const Gas& gas, const PairGeometry& geometry)
      : of_disks_(gas.box.d == 2), disks_(gas, geometry), spheres_(gas, geometry) {}

  HWY_NOINLINE Contact around(std::uint32_t p, Cell cell, double now) {
    return of_disks_ ? disks_.around(p, cell, now) : spheres_.around(p, cell, now);
  }
  HWY_NOINLINE Contact around_higher(std::uint32_t p, Cell cell) {
    return of_disks_ ? disks_.around_higher(p, cell) : spheres_.around_higher(p, cell);
  }
  HWY_NOINLINE std::pair<Contact, Contact> around_both(std::uint32_t p, Cell p_cell,
                                                       std::uint32_t q, Cell q_cell) {
    return of_disks_ ? disks_.around_both(p, p_cell, q, q_cell)
                     : spheres_.around_both(p, p_cell, q, q_cell);
  }
  HWY_NOINLINE Contact beyond(std::uint32_t p, Cell cell, Face face, double now) {
    return of_disks_ ? disks_.beyond(p, cell, face, now) : spheres_.beyond(p, cell, face, now);
  }
  // Short, and called most often: this one is inlined. A disk, whose v_z is zero, never leaves
  // through a face above or below.
  HWY_INLINE Exit exit(std::uint32_t p, Cell cell, double now) const {
    return spheres_.exit(p, cell, now);
  }

  // (GCC deletes the call of a function that does nothing but prefetch, unless it holds an asm.)
  HWY_NOINLINE void prefetch_bricks_around(Cell cell) const {
    asm volatile("");
    of_disks_ ? disks_.prefetch_bricks_around(cell) : spheres_.prefetch_bricks_around(cell);
  }
  HWY_NOINLINE void prefetch_bricks_beyond(Cell cell, Face face) const {
    asm volatile("");
    of_disks_ ? disks_.prefetch_bricks_beyond(cell, face)
              : spheres_.prefetch_bricks_beyond(cell, face);
  }
  HWY_NOINLINE void prefetch_particles_around(Cell cell) {
    asm volatile("");
    of_disks_ ? disks_.prefetch_particles_around(cell) : spheres_.prefetch_particles_around(cell);
  }
  HWY_NOINLINE void prefetch_particles_beyond(Cell cell, Face face) {
    asm volatile("");
    of_disks_ ? disks_.prefetch_particles_beyond(cell, face)
              : spheres_.prefetch_particles_beyond(cell, face);
  }

 private:
  bool of_disks_;
  SimdSearch<2, PairGeometry> disks_;
  SimdSearch<3, PairGeometry> spheres_;
};

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
