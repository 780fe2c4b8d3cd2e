// SPDX-License-Identifier: GPL-3.0-or-later

// The terms that collisions add to sums. They are added after a window, in the order of time as on
// one thread, so that the sums have the same bits.
#pragma once

#include <cstdint>

#include "engine/parallel/tape.hpp"
#include "engine/support/choose.hpp"

namespace haff::engine {

// Stands in for the clock while a collision happens, and keeps every term that it adds to a sum.
struct CollisionTerms {
  template <int most>
  struct Terms {
    void operator+=(double term) { value[count++] = term; }
    void operator-=(double term) { value[count++] = -term; }
    double value[most] = {};
    unsigned count = 0;
  };
  struct {
    Terms<2> dissipated;
    Terms<1> virial;
  } tally;
  struct {
    double closest2 = 1;
  } invariants;
};

// The terms of one collision.
struct CollisionRecord {
  double time;
  std::uint64_t rank;  // among collisions of exactly the same time
  double virial;
  double dissipated[2];  // the second one for rough particles only
};

// Visits the records of two lists, each in the order of time and rank, in this order. There is no
// branch on which of the two lists has the next record, as this is as good as random.
template <class Visit>
void visit_in_order(const Tape<CollisionRecord>& one, const Tape<CollisionRecord>& other,
                    const Visit& visit) {
  const CollisionRecord* a = one.begin();
  const CollisionRecord* b = other.begin();
  const CollisionRecord* const a_end = one.end();
  const CollisionRecord* const b_end = other.end();
  while (a != a_end && b != b_end) {
    bool second = b->time < a->time;
    if (b->time == a->time) [[unlikely]]
      second = b->rank < a->rank;
    visit(*choose(second, b, a));
    b += choose<std::uint64_t>(second, 1, 0);
    a += choose<std::uint64_t>(second, 0, 1);
  }
  for (; a != a_end; ++a) visit(*a);
  for (; b != b_end; ++b) visit(*b);
}

inline void merge(const Tape<CollisionRecord>& one, const Tape<CollisionRecord>& other,
                  Tape<CollisionRecord>& all) {
  all.resize(one.size() + other.size());
  CollisionRecord* next = all.begin();
  visit_in_order(one, other, [&next](const CollisionRecord& record) { *next++ = record; });
}

}  // namespace haff::engine
