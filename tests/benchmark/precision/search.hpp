// Who does a particle touch first? As engine/search-inl.hpp, eight pairs a vector.
#pragma once

#include <hwy/highway.h>

#include <bit>
#include <limits>
#include <utility>
#include <vector>

#include "engine/search.hpp"  // the table of compression
#include "tests/benchmark/precision/gas.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::single {
namespace hn = hwy::HWY_NAMESPACE;

inline constexpr float never = std::numeric_limits<float>::infinity();
// As in contact.hpp, 2^7 roundings of a sum of order one.
inline constexpr float smallest_approach = 0x1p-17f;

struct Contact {
  float time = never;
  std::uint32_t partner = 0;
};

class Search {
 private:
  // A way in units of L as one of positions. In a dilute gas it may be many boxes long.
  template <class D, class T>
  static HWY_INLINE auto flown_in(D d, T way) {
    return hn::NearestInt(hn::Mul(hn::Sub(way, hn::Round(way)), hn::Set(d, 0x1p32f)));
  }

  HWY_INLINE auto around(Cell cell) const {
    return [this, cell] { return gas_.bricks.around<3>(cell); };
  }
  HWY_INLINE auto beyond(Cell cell, Face face) const {
    return [this, cell, face] { return gas_.bricks.beyond<3>(cell, face); };
  }

 public:
  explicit Search(const Gas& gas) : gas_(gas) {}

  HWY_INLINE Contact around(std::uint32_t p, Cell cell, float now) {
    const std::size_t count = gather(p, around(cell), list_);
    return first_of<false>(p, count, list_.data(), now);
  }
  HWY_INLINE Contact around_higher(std::uint32_t p, Cell cell) {
    const std::size_t count = gather<true>(p, around(cell), list_);
    return first_of<true>(p, count, list_.data(), gas_.particles[p].time);
  }
  HWY_INLINE Contact beyond(std::uint32_t p, Cell cell, Face face, float now) {
    const std::size_t count = gather(p, beyond(cell, face), list_);
    return first_of<false>(p, count, list_.data(), now);
  }
  HWY_INLINE std::pair<Contact, Contact> around_both(std::uint32_t p, Cell p_cell, std::uint32_t q,
                                                     Cell q_cell) {
    const std::size_t p_count = gather(p, around(p_cell), list_);
    const std::size_t q_count = gather(q, around(q_cell), other_list_);
    const float now = gas_.particles[p].time;
    const Contact first = first_of<true>(p, p_count, list_.data(), now);
    const Contact second = first_of<true>(q, q_count, other_list_.data(), now);
    return {first, second};
  }

  HWY_INLINE void prefetch_bricks_around(Cell cell) const { prefetch_bricks(around(cell)); }
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

  HWY_INLINE Exit exit(std::uint32_t p, Cell cell, float now) const {
    const hn::FixedTag<float, 4> d;
    const hn::FixedTag<std::int32_t, 4> di;
    const hn::FixedTag<std::uint32_t, 4> du;
    const Particle& own = gas_.particles[p];
    alignas(16) static constexpr std::uint32_t shifts[4] = {0, 10, 20, 30};
    const auto v = hn::IfThenElseZero(hn::FirstN(d, 3), hn::Load(d, own.velocity.data()));
    const auto c =
        hn::And(hn::Shr(hn::Set(du, cell.packed), hn::Load(du, shifts)), hn::Set(du, 1023));
    const auto centre = hn::Mul(hn::BitCast(di, hn::Add(hn::Add(c, c), hn::Set(du, 1))),
                                hn::Set(di, gas_.bricks.half_cell()));
    const auto flown = flown_in(d, hn::Mul(v, hn::Set(d, (now - own.time) * gas_.box.inverse)));
    const auto x = hn::Add(hn::BitCast(di, hn::Load(du, own.position.data())), flown);
    const auto to_centre = hn::Mul(hn::ConvertTo(d, hn::Sub(centre, x)), hn::Set(d, gas_.box.unit));
    const auto ahead = hn::Xor(to_centre, hn::And(v, hn::SignBit(d)));
    const auto distance =
        hn::Max(hn::Add(hn::Set(d, 0.5f * gas_.bricks.cell_side()), ahead), hn::Set(d, 1e-30f));
    const auto time = hn::Div(distance, hn::Abs(v));
    const auto first = hn::MinOfLanes(d, time);
    std::uint8_t mask = 0;
    hn::StoreMaskBits(d, hn::Eq(time, first), &mask);
    const std::size_t bits = mask;
    const auto axis = static_cast<unsigned>(std::countr_zero(bits));
    return {now + hn::GetLane(first), 2 * axis + (own.velocity[axis] > 0 ? 1u : 0u)};
  }

 private:
  template <class Where>
  HWY_INLINE void prefetch_bricks(const Where& where) const {
    for (const std::uint32_t brick : where().brick)
      __builtin_prefetch(&gas_.bricks.line(brick), 0, 2);
  }
  template <class Where>
  HWY_INLINE void prefetch_particles(const Where& where) {
    const std::size_t count = gather(0, where, list_);
    for (std::size_t k = 0; k < count; ++k) __builtin_prefetch(record(list_[k]), 0, 3);
  }

  using Lanes = hn::FixedTag<float, 8>;
  using Ints = hn::FixedTag<std::int32_t, 8>;
  using Slots = hn::FixedTag<std::uint32_t, 8>;
  using V = hn::Vec<Lanes>;
  using I = hn::Vec<Ints>;
  static constexpr std::size_t slack = 16;
  using List = std::vector<std::uint32_t>;

  template <bool higher = false, class Where>
  HWY_INLINE std::size_t gather(std::uint32_t p, const Where& where, List& list) {
    const auto wanted = where();
    const std::uint32_t* const slots = gas_.bricks.all_slots();
    std::uint32_t* const to = list.data();
    std::size_t count = 0;
    std::uint32_t more = 0;
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

  template <bool higher>
  HWY_INLINE std::size_t take_half(std::uint32_t p, const std::uint32_t* slot, std::uint32_t like,
                                   const Bricks::Care& care, std::uint32_t* to) const {
    const Slots d;
    const auto slots = hn::Load(d, slot);
    const auto differ = hn::And(hn::Xor(slots, hn::Set(d, like)), hn::Load(d, care.data()));
    auto wanted = hn::Eq(differ, hn::Zero(d));
    if constexpr (higher)
      wanted = hn::And(wanted, hn::Gt(slots, hn::Set(d, p << Bricks::particle_shift | 15)));
    std::uint8_t mask = 0;
    hn::StoreMaskBits(d, wanted, &mask);
    const std::size_t bits = mask;
    const auto lanes = hn::IndicesFromVec(
        d, hn::PromoteTo(
               d, hn::Load(hn::Rebind<std::uint8_t, Slots>(), engine::compress_table.lanes[bits])));
    const auto particles = hn::And(slots, hn::Set(d, Bricks::particle_bits));
    hn::StoreU(hn::TableLookupLanes(particles, lanes), d, to);
    return static_cast<std::size_t>(std::popcount(bits));
  }

  // A slot is the particle's number times sixteen: times two bytes.
  HWY_INLINE const float* record(std::uint32_t candidate) const {
    static_assert(sizeof(Particle) == 32 && Bricks::particle_shift == 4);
    return reinterpret_cast<const float*>(
        reinterpret_cast<const std::uint16_t*>(gas_.particles.data()) + candidate);
  }

  struct Records {
    I x, y, z;
    V t, vx, vy, vz;
  };
  HWY_INLINE Records load(const std::uint32_t* candidate) const {
    const Lanes d;
    const Ints di;
    const hn::Repartition<double, Lanes> pairs;
    const auto transpose = [&](std::size_t k, V & a, V & b, V & c, V & e) HWY_ATTR
        __attribute__((always_inline)) {
      const auto at = [&](std::size_t lane) HWY_ATTR {
        return hn::Load(hn::FixedTag<float, 4>(), record(candidate[lane]) + k);
      };
      const V r0 = hn::Combine(d, at(4), at(0));
      const V r1 = hn::Combine(d, at(5), at(1));
      const V r2 = hn::Combine(d, at(6), at(2));
      const V r3 = hn::Combine(d, at(7), at(3));
      const auto l01 = hn::BitCast(pairs, hn::InterleaveLower(d, r0, r1));
      const auto l23 = hn::BitCast(pairs, hn::InterleaveLower(d, r2, r3));
      const auto u01 = hn::BitCast(pairs, hn::InterleaveUpper(d, r0, r1));
      const auto u23 = hn::BitCast(pairs, hn::InterleaveUpper(d, r2, r3));
      a = hn::BitCast(d, hn::InterleaveLower(pairs, l01, l23));
      b = hn::BitCast(d, hn::InterleaveUpper(pairs, l01, l23));
      c = hn::BitCast(d, hn::InterleaveLower(pairs, u01, u23));
      e = hn::BitCast(d, hn::InterleaveUpper(pairs, u01, u23));
    };
    Records r;
    V x, y, z, changes;
    transpose(0, x, y, z, r.t);
    transpose(4, r.vx, r.vy, r.vz, changes);
    r.x = hn::BitCast(di, x);
    r.y = hn::BitCast(di, y);
    r.z = hn::BitCast(di, z);
    return r;
  }

  struct Approach {
    V approach, gap, discriminant;
  };
  template <bool fresh>
  HWY_INLINE Approach meet(std::uint32_t p, const std::uint32_t* candidates, float now) const {
    const Lanes d;
    const Ints di;
    const Particle& own = gas_.particles[p];
    const Records other = load(candidates);
    // Both as they are now, rounded to positions: of whatever images they fly past, the nearest.
    const V flight = hn::Mul(hn::Sub(hn::Set(d, now), other.t), hn::Set(d, gas_.box.inverse));
    const V own_flight = hn::Set(d, (now - own.time) * gas_.box.inverse);
    const auto relative = [&](std::size_t axis, I position, V velocity, V & r, V & v) HWY_ATTR
        __attribute__((always_inline)) {
      const V own_v = hn::Set(d, own.velocity[axis]);
      I own_x = hn::Set(di, static_cast<std::int32_t>(own.position[axis]));
      if constexpr (!fresh) own_x = hn::Add(own_x, flown_in(d, hn::Mul(own_v, own_flight)));
      const I x = hn::Add(position, flown_in(d, hn::Mul(velocity, flight)));
      r = hn::Mul(hn::ConvertTo(d, hn::Sub(x, own_x)), hn::Set(d, gas_.box.unit));
      v = hn::Sub(velocity, own_v);
    };
    V rx, ry, rz, vx, vy, vz;
    relative(0, other.x, other.vx, rx, vx);
    relative(1, other.y, other.vy, ry, vy);
    relative(2, other.z, other.vz, rz, vz);
    const V approach = dot(rx, ry, rz, vx, vy, vz);
    const V gap = hn::Sub(dot(rx, ry, rz, rx, ry, rz), hn::Set(d, 1.0f));
    return {approach, gap,
            hn::Sub(hn::Mul(approach, approach), hn::Mul(dot(vx, vy, vz, vx, vy, vz), gap))};
  }

  struct First {
    HWY_INLINE explicit First(std::uint32_t p)
        : time(hn::Set(Lanes(), never)), slot(hn::Set(Slots(), p << Bricks::particle_shift)) {}
    HWY_INLINE void take(const Approach& pair, const std::uint32_t* candidates, float now) {
      const Lanes d;
      const V flight = hn::Div(hn::Max(pair.gap, hn::Zero(d)),
                               hn::Sub(hn::Sqrt(pair.discriminant), pair.approach));
      const auto apart = hn::Ge(pair.approach, hn::Set(d, -smallest_approach));
      const V at = hn::Or(hn::Add(hn::Set(d, now), flight), hn::VecFromMask(d, apart));
      const auto earlier = hn::Lt(at, time);
      time = hn::IfThenElse(earlier, at, time);
      slot = hn::IfThenElse(hn::RebindMask(Slots(), earlier), hn::LoadU(Slots(), candidates), slot);
    }
    V time;
    hn::Vec<Slots> slot;
  };

  template <bool fresh>
  HWY_INLINE Contact first_of(std::uint32_t p, std::size_t count, const std::uint32_t* candidates,
                              float now) {
    const Lanes d;
    First first(p);
    Approach current = meet<fresh>(p, candidates, now);
    std::size_t k = 0;
    for (; k + 8 < count; k += 8) {
      const Approach next = meet<fresh>(p, candidates + k + 8, now);
      first.take(current, candidates + k, now);
      current = next;
    }
    first.take(current, candidates + k, now);
    const V earliest = hn::MinOfLanes(d, first.time);
    std::uint8_t mask = 0;
    hn::StoreMaskBits(d, hn::Eq(first.time, earliest), &mask);
    const std::size_t bits = mask;
    alignas(32) std::array<std::uint32_t, 8> slot;
    hn::Store(first.slot, Slots(), slot.data());
    return {hn::GetLane(earliest),
            Bricks::particle_in(slot[static_cast<std::size_t>(std::countr_zero(bits))])};
  }

  static HWY_INLINE V dot(V ax, V ay, V az, V bx, V by, V bz) {
    return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
  }

  const Gas& gas_;
  List list_ = List(8 * Bricks::slots + slack);
  List other_list_ = list_;
};

}  // namespace haff::single
HWY_AFTER_NAMESPACE();
