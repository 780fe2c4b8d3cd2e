// SPDX-License-Identifier: GPL-3.0-or-later

// Finds the particle that a particle touches first. The plain search tests one candidate after the
// other; simd_search-inl.hpp has the fast search.
#pragma once

#include <utility>
#include <vector>

#include "engine/collision/pair_geometry.hpp"
#include "engine/loop/gas.hpp"
#include "engine/support/choose.hpp"

namespace haff::engine {

struct Contact {
  double time = never;
  std::uint32_t partner = 0;
};

// Row m holds the positions of the set bits of m: a permutation that moves the wanted lanes of a
// vector to its front. (Highway's own Compress, when built by GCC 12, copies its table to the stack
// at each call, which takes 40 % of a search.)
struct CompressTable {
  constexpr CompressTable() {
    for (std::uint32_t mask = 0; mask < 256; ++mask)
      for (std::uint32_t bit = 0, next = 0; bit < 8; ++bit)
        if ((mask >> bit & 1) != 0) lanes[mask][next++] = static_cast<std::uint8_t>(bit);
  }
  alignas(8) std::uint8_t lanes[256][8] = {};
};
inline constexpr CompressTable compress_table;

// Whether one contact comes before the other; at exactly the same time, the one with the smaller id
// does. Which is earlier is as good as random, so this is written to be computed without a branch.
inline bool comes_before(const Contact& one, const Contact& other,
                         const HugeVector<Particle>& particles) {
  bool earlier = one.time < other.time;
  if (all_of(one.time == other.time, one.time < never)) [[unlikely]]
    earlier = particles[one.partner].id < particles[other.partner].id;
  return earlier;
}

inline void keep_first(Contact& best, const Contact& other, const HugeVector<Particle>& particles) {
  const bool earlier = comes_before(other, best, particles);
  best.time = earlier ? other.time : best.time;
  best.partner = earlier ? other.partner : best.partner;
}

// Candidates: the particles in the wanted cells, each as its nearest image.
struct NearbyNearestImage {
  template <int d, std::size_t count, class Visit>
  static void visit(const Gas& gas, const Bricks::Wanted<count>& wanted, const Visit& visit) {
    for (std::size_t n = 0; n < count; ++n) {
      const auto take = [&](std::uint32_t slot) {
        if (wanted.holds(n, slot)) visit(Bricks::particle_in(slot), Vector{0, 0, 0});
      };
      for (const std::uint32_t slot : gas.bricks.line(wanted.brick[n]).slot) take(slot);
      for (const std::uint32_t slot : gas.bricks.overflow(wanted.brick[n])) take(slot);
    }
  }
};

// The 27 boxes around the nearest image (9 for disks).
template <int d, class Visit>
void visit_images(std::uint32_t q, const Visit& visit) {
  for (int image = 0; image < (d == 2 ? 9 : 27); ++image)
    visit(q, Vector{image % 3 - 1.0, image / 3 % 3 - 1.0, d == 2 ? 0 : image / 9 - 1.0});
}

// Candidates where two neighbouring cells are half the box: the particles in the wanted cells, each
// as all of its images. Two particles on opposite faces of such cells are half a box apart, and
// rounding decides which image is the nearest.
struct NearbyAllImages {
  template <int d, std::size_t count, class Visit>
  static void visit(const Gas& gas, const Bricks::Wanted<count>& wanted, const Visit& visit) {
    NearbyNearestImage::visit<d>(
        gas, wanted, [&](std::uint32_t q, const Vector&) { visit_images<d>(q, visit); });
  }
};

// Candidates in a box so small that a particle can meet two images of another one: all particles,
// each as all of its images.
struct AllParticlesAllImages {
  template <int d, std::size_t count, class Visit>
  static void visit(const Gas& gas, const Bricks::Wanted<count>&, const Visit& visit) {
    for (std::uint32_t q = 0; q < gas.particles.size(); ++q) visit_images<d>(q, visit);
  }
};

// Tests one candidate after the other. It gives the same bits as the SIMD search, which is tested
// against it.
template <class Physics, class Candidates = NearbyNearestImage, int d = 3>
class PlainSearch {
 public:
  PlainSearch(const Gas& gas, const Physics& physics) : gas_(gas), physics_(physics) {}

  Contact around(std::uint32_t p, Cell cell, double now) const {
    return first_in(p, gas_.bricks.around<d>(cell), now);
  }
  // Searches only among particles with higher numbers, for a particle whose record is of the
  // present time.
  Contact around_higher(std::uint32_t p, Cell cell) const {
    return first_in(p, gas_.bricks.around<d>(cell), gas_.particles[p].time, p + 1);
  }
  std::pair<Contact, Contact> around_both(std::uint32_t p, Cell p_cell, std::uint32_t q,
                                          Cell q_cell) const {
    const double now = gas_.particles[p].time;
    return {around(p, p_cell, now), around(q, q_cell, now)};
  }
  Contact beyond(std::uint32_t p, Cell cell, Face face, double now) const {
    return first_in(p, gas_.bricks.beyond<d>(cell, face), now);
  }
  Exit exit(std::uint32_t p, Cell cell, double now) const {
    return gas_.bricks.exit<d>(gas_.particles[p], cell, now);
  }
  void prefetch_bricks_around(Cell) const {}
  void prefetch_bricks_beyond(Cell, Face) const {}
  void prefetch_particles_around(Cell) const {}
  void prefetch_particles_beyond(Cell, Face) const {}

 private:
  template <std::size_t count>
  Contact first_in(std::uint32_t p, const Bricks::Wanted<count>& wanted, double now,
                   std::uint32_t lowest = 0) const {
    Contact best;
    Candidates::template visit<d>(gas_, wanted, [&](std::uint32_t q, const Vector& image) {
      if (q == p || q < lowest) return;
      const Particle& own = gas_.particles[p];
      const Particle& other = gas_.particles[q];
      const Encounter pair(own, other, now, gas_.box, image);
      keep_first(best, {physics_.contact_time(pair, own, other), q}, gas_.particles);
    });
    return best;
  }

  const Gas& gas_;
  Physics physics_;
};

}  // namespace haff::engine
