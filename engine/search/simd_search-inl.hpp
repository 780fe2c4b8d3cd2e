// SPDX-License-Identifier: GPL-3.0-or-later

// Finds the particle that a particle touches first: tests all candidates at once, without branches.
//
// The slots of a neighbourhood are filtered and compressed to a list of some 13 candidates. Their
// records are loaded four at a time, transposed in registers to one vector per coordinate, and
// solved with the operations of HardSpheres::contact_time() (pair_geometry.hpp), one for one and
// unfused, so the bits are the same for any vector width. A scalar test with early exits spends its
// time on mispredicted branches: this search doubled the speed of the whole engine.
#if defined(HAFF_ENGINE_SEARCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAFF_ENGINE_SEARCH_INL
#undef HAFF_ENGINE_SEARCH_INL
#else
#define HAFF_ENGINE_SEARCH_INL
#endif

#include <hwy/highway.h>

#include <bit>
#include <type_traits>

#include "engine/search/plain_search.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// `dimension` is called d elsewhere; here Highway's tags have that name.
// A processor without vectors gains nothing from emulated ones. (Highway 1.0.3 emulates MinOfLanes
// wrongly, too: it finds the largest finite number where all lanes are infinite.)
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
template <int dimension = 3, class PairGeometry = HardSpheres>
using SimdSearch = PlainSearch<PairGeometry, NearbyNearestImage, dimension>;
#else

template <int dimension = 3, class PairGeometry = HardSpheres>
class SimdSearch {
 public:
  SimdSearch(const Gas& gas, const PairGeometry& bodies) : gas_(gas), geometry_(bodies) {}

  HWY_INLINE Contact around(std::uint32_t p, Cell cell, double now) {
    const std::size_t count = gather(p, around(cell), list_);
    return first_of<false>(p, count, list_.data(), now);
  }
  HWY_INLINE Contact around_higher(std::uint32_t p, Cell cell) {
    const std::size_t count = gather<true>(p, around(cell), list_);
    return first_of<true>(p, count, list_.data(), gas_.particles[p].time);
  }
  HWY_INLINE Contact beyond(std::uint32_t p, Cell cell, Face face, double now) {
    const std::size_t count = gather(p, beyond(cell, face), list_);
    return first_of<false>(p, count, list_.data(), now);
  }

  // Searches for both partners of a collision. Gathering the candidates of both before solving for
  // either lets the processor overlap the two searches.
  HWY_INLINE std::pair<Contact, Contact> around_both(std::uint32_t p, Cell p_cell, std::uint32_t q,
                                                     Cell q_cell) {
    const std::size_t p_count = gather(p, around(p_cell), list_);
    const std::size_t q_count = gather(q, around(q_cell), other_list_);
    const double now = gas_.particles[p].time;
    const Contact first = first_of<true>(p, p_count, list_.data(), now);
    const Contact second = first_of<true>(q, q_count, other_list_.data(), now);
    return {first, second};
  }

  HWY_INLINE void prefetch_bricks_around(Cell cell) const { prefetch_bricks(around(cell)); }
  // Prefetches for a particle that is about to leave a cell through a face: it will search beyond
  // the same face of the next cell.
  HWY_INLINE void prefetch_bricks_beyond(Cell cell, Face face) const {
    const Cell next = gas_.bricks.across(cell, face);
    prefetch_bricks(beyond(next, face));
    __builtin_prefetch(&gas_.bricks.line(gas_.bricks.brick_of(next)), 1, 2);
    __builtin_prefetch(&gas_.bricks.line(gas_.bricks.brick_of(cell)), 1, 2);
  }
  HWY_INLINE void prefetch_particles_around(Cell cell) { prefetch_particles(around(cell)); }
  HWY_INLINE void prefetch_particles_beyond(Cell cell, Face face) {
    prefetch_particles(beyond(gas_.bricks.across(cell, face), face));
  }

  // Bricks::exit() for all axes at once.
  HWY_INLINE Exit exit(std::uint32_t p, Cell cell, double now) const {
#if HWY_CAP_GE256
    const Particle& own = gas_.particles[p];
    const Reals d;
    const hn::Rebind<std::uint32_t, Reals> d32;
    alignas(16) static constexpr std::uint32_t shifts[4] = {0, 10, 20, 30};
    const auto axes = hn::FirstN(d, dimension);
    const V v = hn::IfThenElseZero(axes, hn::Load(d, own.velocity.data()));
    const V x = hn::Add(hn::Load(d, own.position.data()), hn::Mul(v, hn::Set(d, now - own.time)));
    const auto shifted = hn::Shr(hn::Set(d32, cell.packed), hn::Load(d32, shifts));
    const V coordinate = hn::PromoteTo(
        d, hn::BitCast(hn::RebindToSigned<decltype(d32)>(), hn::And(shifted, hn::Set(d32, 1023))));
    const Bricks& bricks = gas_.bricks;
    V to_centre =
        hn::Sub(hn::Mul(hn::Add(coordinate, hn::Set(d, 0.5)), hn::Set(d, bricks.cell_side())), x);
    to_centre =
        hn::Sub(to_centre, hn::Mul(hn::Round(hn::Mul(to_centre, hn::Set(d, gas_.box.inverse))),
                                   hn::Set(d, gas_.box.side)));
    const V ahead = hn::Xor(to_centre, hn::And(v, hn::SignBit(d)));
    // Not zero: 0 / 0 would be taken for a time.
    const V distance =
        hn::Max(hn::Add(hn::Set(d, 0.5 * bricks.cell_side()), ahead), hn::Set(d, 1e-300));
    const V time = hn::Div(distance, hn::Abs(v));  // infinite where the particle does not move
    const V first = hn::MinOfLanes(d, time);
    std::uint8_t mask = 0;
    hn::StoreMaskBits(d, hn::Eq(time, first), &mask);
    const std::size_t bits = mask;
    const auto axis = static_cast<unsigned>(std::countr_zero(bits));
    return {now + hn::GetLane(first), 2 * axis + (own.velocity[axis] > 0 ? 1u : 0u)};
#else
    return gas_.bricks.exit<dimension>(gas_.particles[p], cell, now);
#endif
  }

 private:
  // Where to search, as a function: the rare paths call it again, so the common path need not keep
  // the result.
  HWY_INLINE auto around(Cell cell) const {
    return [ this, cell ]() HWY_ATTR __attribute__((always_inline)) {
      return gas_.bricks.around<dimension>(cell);
    };
  }
  HWY_INLINE auto beyond(Cell cell, Face face) const {
    return [ this, cell, face ]() HWY_ATTR __attribute__((always_inline)) {
      return gas_.bricks.beyond<dimension>(cell, face);
    };
  }

  template <class Where>
  HWY_INLINE void prefetch_bricks(const Where& where) const {
    for (const std::uint32_t brick : where().brick)
      __builtin_prefetch(&gas_.bricks.line(brick), 0, 2);
  }
  template <class Where>
  HWY_INLINE void prefetch_particles(const Where& where) {
    // The particles are needed within a few events: they go into the first-level cache.
    const std::size_t count = gather(0, where, list_);
    for (std::size_t k = 0; k < count; ++k)
      __builtin_prefetch(gas_.particles.data() + Bricks::particle_in(list_[k]), 0, 3);
  }

  static constexpr bool all_alike = std::is_same_v<PairGeometry, HardSpheres>;

  using Slots = hn::CappedTag<std::uint32_t, 8>;
  using Reals = hn::CappedTag<double, 4>;
  using V = hn::Vec<Reals>;
  static constexpr std::size_t slack = 16;  // compressed stores write whole vectors

  using List = std::vector<std::uint32_t>;

  // Lists the particle numbers of the wanted slots. After the last one comes p itself, which fills
  // a vector (no particle touches itself). `higher`: only particles with higher numbers.
  template <bool higher = false, class Where>
  HWY_INLINE std::size_t gather(std::uint32_t p, const Where& where, List& list) {
    const auto wanted = where();
    // Local copies: the compiler would read the members again after every store.
    const std::uint32_t* const slots = gas_.bricks.all_slots();
    std::uint32_t* const to = list.data();
    std::size_t count = 0;
    std::uint32_t more = 0;  // slots are filled from the front
#pragma GCC unroll 8
    for (std::size_t n = 0; n < wanted.brick.size(); ++n) {
      const std::uint32_t* const slot = slots + wanted.brick[n];
      count += take_half<higher>(p, slot, wanted.like, wanted.care[n], to + count);
      more |= slot[8];
    }
    if (HWY_UNLIKELY(more != 0)) count = gather_rest<higher>(p, where, list, count);
    const Slots d;
    hn::StoreU(hn::Set(d, p << Bricks::particle_shift), d, list.data() + count);
    return count;
  }

  // The second halves of the lines, and the overflow lists.
  template <bool higher, class Where>
  HWY_NOINLINE std::size_t gather_rest(std::uint32_t p, Where where, List& list,
                                       std::size_t count) {
    const auto wanted = where();
    for (std::size_t n = 0; n < wanted.brick.size(); ++n) {
      const auto& slot = gas_.bricks.line(wanted.brick[n]).slot;
      if (slot[8] != 0)
        count +=
            take_half<higher>(p, slot.data() + 8, wanted.like, wanted.care[n], list.data() + count);
      if (HWY_LIKELY(slot[15] == 0)) continue;
      for (const std::uint32_t extra : gas_.bricks.overflow(wanted.brick[n])) {
        if (!wanted.holds(n, extra) || (higher && Bricks::particle_in(extra) < p)) continue;
        list[count++] = extra & Bricks::particle_bits;
        if (list.size() < count + 8 * Bricks::slots + slack) list.resize(2 * list.size());
      }
    }
    return count;
  }

  // Writes those of eight slots that are wanted; returns their number.
  template <bool higher>
  HWY_INLINE std::size_t take_half(std::uint32_t p, const std::uint32_t* slot, std::uint32_t like,
                                   const Bricks::Care& care, std::uint32_t* to) const {
    const Slots d;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 8; k += hn::MaxLanes(d)) {
      const auto slots = hn::Load(d, slot + k);
      const auto differ = hn::And(hn::Xor(slots, hn::Set(d, like)), hn::Load(d, care.data()));
      auto wanted = hn::Eq(differ, hn::Zero(d));
      if constexpr (higher)
        wanted = hn::And(wanted, hn::Gt(slots, hn::Set(d, p << Bricks::particle_shift | 15)));
      std::uint8_t mask = 0;
      hn::StoreMaskBits(d, wanted, &mask);
      const std::size_t bits = mask;
      const auto lanes = hn::IndicesFromVec(
          d, hn::PromoteTo(
                 d, hn::Load(hn::Rebind<std::uint8_t, Slots>(), compress_table.lanes[bits])));
      const auto particles = hn::And(slots, hn::Set(d, Bricks::particle_bits));
      hn::StoreU(hn::TableLookupLanes(particles, lanes), d, to + count);
      count += static_cast<std::size_t>(std::popcount(bits));
    }
    return count;
  }

  struct Records {
    HWY_INLINE Records() {}  // written out, it is compiled for the SIMD target of its members
    V x, y, z, t, vx, vy, vz;
    V names;  // the bits of id and changes
  };

  // The records of as many candidates as a vector has lanes, one coordinate per vector.
  HWY_INLINE Records load(const std::uint32_t* candidate) const {
    const Reals d;
    // A slot without its tag is the particle number times 16; times four bytes it is an address.
    static_assert(sizeof(Particle) == 64 && Bricks::particle_shift == 4);
    const auto* const all = reinterpret_cast<const float*>(gas_.particles.data());
    const auto pair = [&](std::size_t k, V & low, V & high) HWY_ATTR
        __attribute__((always_inline)) {
      // Two neighbouring doubles of each record; records 0 and 2, and 1 and 3, share a vector.
      const auto at = [&](std::size_t lane) HWY_ATTR {
        return hn::Load(hn::FixedTag<double, 2>(),
                        reinterpret_cast<const double*>(all + candidate[lane]) + k);
      };
#if HWY_CAP_GE256
      const V even = hn::Combine(d, at(2), at(0));
      const V odd = hn::Combine(d, at(3), at(1));
#else
      const V even = at(0);
      const V odd = at(1);
#endif
      low = hn::InterleaveLower(d, even, odd);
      high = hn::InterleaveUpper(d, even, odd);
    };
    Records r;
    pair(0, r.x, r.y);
    pair(2, r.z, r.t);
    pair(4, r.vx, r.vy);
    if constexpr (dimension == 3 || !all_alike) pair(6, r.vz, r.names);
    return r;
  }

  // The first contact with one of the candidates. `fresh`: the particle's own record is of the
  // present time, so no other record is later and half the work is unnecessary. No branch depends
  // on which candidates touch: a root is computed for every candidate, although only one in ten has
  // one. Roots take long; those of one vector are computed after the next vector has been begun, so
  // that nothing waits for them.
  template <bool fresh>
  HWY_INLINE Contact first_of(std::uint32_t p, std::size_t count, const std::uint32_t* candidates,
                              double now) {
    const Reals d;
    First first(count);
    Approach current = meet<fresh>(p, candidates, now);
    std::size_t k = 0;
    for (; k + hn::MaxLanes(d) < count; k += hn::MaxLanes(d)) {
      const Approach next = meet<fresh>(p, candidates + k + hn::MaxLanes(d), now);
      first.take(current, k);
      current = next;
    }
    first.take(current, k);

    const V earliest = hn::MinOfLanes(d, first.time);
    std::uint8_t mask = 0;
    hn::StoreMaskBits(d, hn::Eq(first.time, earliest), &mask);
    const std::size_t bits = mask;
    alignas(32) std::array<std::uint64_t, hn::MaxLanes(Reals())> place;
    hn::Store(first.place, Names(), place.data());
    const double time = hn::GetLane(earliest);
    if (HWY_UNLIKELY((int{(bits & (bits - 1)) != 0} & int{time < never}) |
                     int{!hn::AllFalse(d, hn::MaskFromVec(first.tie))}))
      return first_by_id(p, count, candidates, now);
    const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
    return {time, Bricks::particle_in(candidates[place[lane] + lane])};
  }

  // The same, one candidate after the other, for two candidates with exactly the same time.
  HWY_NOINLINE Contact first_by_id(std::uint32_t p, std::size_t count,
                                   const std::uint32_t* candidates, double now) const {
    Contact best;
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t q = Bricks::particle_in(candidates[k]);
      const Particle& own = gas_.particles[p];
      const Particle& other = gas_.particles[q];
      if (q == p) continue;
      keep_first(best, {geometry_.contact_time({own, other, now, gas_.box}, own, other), q},
                 gas_.particles);
    }
    return best;
  }

  // The encounters with as many candidates as a vector has lanes (Encounter).
  struct Approach {
    V start, approach, gap, discriminant;
  };

  template <bool fresh>
  HWY_INLINE Approach meet(std::uint32_t p, const std::uint32_t* candidates, double now) const {
    const Reals d;
    const Particle& own = gas_.particles[p];
    const V now_v = hn::Set(d, now);
    const V own_time = hn::Set(d, own.time);
    const Records other = load(candidates);
    const V start = fresh ? now_v : hn::Max(own_time, other.t);
    const V other_flight = hn::Sub(start, other.t);
    const V own_flight = hn::Sub(start, own_time);
    const V to_now = hn::Sub(now_v, start);
    const auto relative = [&](std::size_t axis, V position, V velocity, V & r, V & v) HWY_ATTR
        __attribute__((always_inline)) {
      const V own_v = hn::Set(d, own.velocity[axis]);
      V own_x = hn::Set(d, own.position[axis]);
      if constexpr (!fresh) own_x = hn::Add(own_x, hn::Mul(own_v, own_flight));
      r = hn::Sub(hn::Add(position, hn::Mul(velocity, other_flight)), own_x);
      v = hn::Sub(velocity, own_v);
      const V seen = fresh ? r : hn::Add(r, hn::Mul(v, to_now));
      const V boxes = hn::Round(hn::Mul(seen, hn::Set(d, gas_.box.inverse)));
      r = hn::Sub(r, hn::Mul(boxes, hn::Set(d, gas_.box.side)));
    };
    V rx, ry, vx, vy;
    V rz = hn::Zero(d), vz = rz;
    relative(0, other.x, other.vx, rx, vx);
    relative(1, other.y, other.vy, ry, vy);
    if constexpr (dimension == 3) relative(2, other.z, other.vz, rz, vz);
    const V approach = dot(rx, ry, rz, vx, vy, vz);
    const V gap = hn::Sub(dot(rx, ry, rz, rx, ry, rz), contact2(own, other));
    return {start, approach, gap,
            hn::Sub(hn::Mul(approach, approach), hn::Mul(dot(vx, vy, vz, vx, vy, vz), gap))};
  }

  // The squared distances at contact. The species follows from the id, the lower half of `names`.
  HWY_INLINE V contact2(const Particle& own, const Records& other) const {
    const Reals d;
    if constexpr (all_alike) {
      return hn::Set(d, 1.0);
    } else {
      const hn::RebindToSigned<Reals> names;
      const auto id = hn::And(hn::BitCast(names, other.names), hn::Set(names, 0xffffffff));
      const auto is_first = hn::Lt(id, hn::Set(names, geometry_.mixture().first));
      return hn::IfThenElse(hn::RebindMask(d, is_first),
                            hn::Set(d, geometry_.contact2_with_first(own)),
                            hn::Set(d, geometry_.contact2_with_second(own)));
    }
  }

  using Names = hn::RebindToUnsigned<Reals>;

  // For the candidates seen in each lane so far: the time of the first contact, and the place in
  // the list of the vector that the partner was in; at first the place after the last candidate,
  // where p is. (To load the partner itself from the list takes longer: the list has just been
  // written in other pieces, so the load has to wait until all that was written before has reached
  // the cache.)
  struct First {
    HWY_INLINE explicit First(std::size_t count)
        : time(hn::Set(Reals(), never)), place(hn::Set(Names(), count)), tie(hn::Zero(Reals())) {}

    HWY_INLINE void take(const Approach& pair, std::size_t k) {
      const Reals d;
      const V flight = hn::Div(hn::Max(pair.gap, hn::Zero(d)),
                               hn::Sub(hn::Sqrt(pair.discriminant), pair.approach));
      // The time is not a number for candidates that pass by (the root of a negative number) and
      // for candidates that do not approach: it is then neither earlier than nor equal to any time.
      const auto apart = hn::Ge(pair.approach, hn::Set(d, -smallest_approach));
      const V at = hn::Or(hn::Add(pair.start, flight), hn::VecFromMask(d, apart));
      const auto earlier = hn::Lt(at, time);
      tie = hn::Or(tie, hn::VecFromMask(d, hn::Eq(at, time)));
      time = hn::IfThenElse(earlier, at, time);
      place = hn::IfThenElse(hn::RebindMask(Names(), earlier), hn::Set(Names(), k), place);
    }

    V time;
    hn::Vec<Names> place;
    V tie;  // all bits set where two touched at the same time
  };

  static HWY_INLINE V dot(V ax, V ay, V az, V bx, V by, V bz) {
    const V planar = hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by));
    if constexpr (dimension == 2) return planar;
    return hn::Add(planar, hn::Mul(az, bz));
  }

  const Gas& gas_;
  [[no_unique_address]] PairGeometry geometry_;
  List list_ = List(8 * Bricks::slots + slack);
  List other_list_ = list_;
};

#endif

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
