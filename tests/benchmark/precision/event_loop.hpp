// As engine/event_loop-inl.hpp.
#pragma once
#include "tests/benchmark/precision/search.hpp"

namespace haff::single {

template <bool prefetching>
class EventLoop {
 public:
  EventLoop(Gas& gas, double e)
      : gas_(gas),
        search_(gas),
        e_(e),
        now_(static_cast<float>(gas.clock.now)),
        collisions_(gas.clock.collisions) {}

  void run(std::int64_t collisions) {
    while (collisions_ < collisions) {
      const std::uint32_t p = gas_.calendar.next();
      if (p == Calendar::nobody)
        throw engine::Breakdown("no particle will ever meet another again");
      if constexpr (prefetching) look_ahead();
      const Event& event = gas_.calendar[p];
      if (event.time < now_) [[unlikely]] {
        ++gas_.clock.invariants.past_events;
        gas_.latest = std::max(gas_.latest, double{now_ - event.time});
      } else {
        now_ = event.time;
      }
      if (event.face != Event::contact)
        cross(p);
      else if (gas_.particles[event.partner].changes == event.partner_changes)
        collide(p, event.partner);
      else
        look_again(p);
    }
    gas_.clock.now = now_;
    gas_.clock.collisions = collisions_;
  }

  void predict_all() {
    for (std::uint32_t p = 0; p < gas_.particles.size(); ++p)
      expect(p, search_.around_higher(p, gas_.calendar[p].cell));
  }

 private:
  using Four [[gnu::vector_size(16)]] = float;
  using Wide [[gnu::vector_size(32)]] = double;
  using FourInts [[gnu::vector_size(16)]] = std::int32_t;

  [[gnu::always_inline]] static FourInts flown_in(Four way) {
    const __m128 w = reinterpret_cast<__m128>(way);
    const __m128 rest =
        _mm_sub_ps(w, _mm_round_ps(w, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
    return reinterpret_cast<FourInts>(_mm_cvtps_epi32(_mm_mul_ps(rest, _mm_set1_ps(0x1p32f))));
  }

  struct Halves {
    [[gnu::always_inline]] Halves(const Particle& p, float now, const Box& box) {
      std::memcpy(&position, &p.position, 16);
      std::memcpy(&names, &p.velocity, 16);
      velocity = reinterpret_cast<Four>(names & FourInts{-1, -1, -1, 0});
      position += flown_in(velocity * ((now - p.time) * box.inverse));
      position[3] = std::bit_cast<std::int32_t>(now);
    }
    [[gnu::always_inline]] void write(Particle& p) const {
      const FourInts half = (reinterpret_cast<FourInts>(velocity) & FourInts{-1, -1, -1, 0}) |
                            ((names & FourInts{0, 0, 0, -1}) + FourInts{0, 0, 0, 1});
      std::memcpy(&p.position, &position, 16);
      std::memcpy(&p.velocity, &half, 16);
    }
    FourInts position;
    Four velocity;
    FourInts names;
  };
  [[gnu::always_inline]] static double dot(const Wide& a, const Wide& b) {
    const Wide products = a * b;
    return (products[0] + products[1]) + products[2];
  }

  void collide(std::uint32_t p, std::uint32_t q) {
    Particle& a = gas_.particles[p];
    Particle& b = gas_.particles[q];
    Halves of_a(a, now_, gas_.box), of_b(b, now_, gas_.box);
    // In double: a quotient by a number that is always just beside one is rounded up more often
    // than down, which heats the gas by 7e-9 of its energy a collision.
    const Wide r = __builtin_convertvector(of_b.position - of_a.position, Wide) * unit_;
    const Wide v = __builtin_convertvector(of_b.velocity - of_a.velocity, Wide);
    const double approach = dot(r, v);
    const double distance2 = dot(r, r);
    const Wide change = 0.5 * (1 + e_) * approach / distance2 * r;
    of_a.velocity =
        __builtin_convertvector(__builtin_convertvector(of_a.velocity, Wide) + change, Four);
    of_b.velocity =
        __builtin_convertvector(__builtin_convertvector(of_b.velocity, Wide) - change, Four);
    of_a.write(a);
    of_b.write(b);
    engine::Clock& clock = gas_.clock;
    clock.tally.virial -= 0.5 * (1 + e_) * approach;
    clock.tally.dissipated += 0.25 * (1 - e_ * e_) * approach * approach / distance2;
    clock.invariants.closest2 = std::min(clock.invariants.closest2, distance2);
    gas_.calendar.forget(q);
    ++collisions_;
    ++gas_.events.collisions;
    const auto [first, second] =
        search_.around_both(p, gas_.calendar[p].cell, q, gas_.calendar[q].cell);
    expect(p, first);
    expect(q, second);
  }

  void cross(std::uint32_t p) {
    ++gas_.events.crossings;
    Event& event = gas_.calendar[p];
    event.cell = gas_.bricks.cross(p, event.cell, event.face);
    const Contact contact = search_.beyond(p, event.cell, event.face, now_);
    const std::uint32_t changes = gas_.particles[contact.partner].changes;
    const bool earlier = contact.time < event.contact_time;
    event.contact_time = choose(earlier, contact.time, event.contact_time);
    event.partner = choose(earlier, contact.partner, event.partner);
    event.partner_changes = choose(earlier, changes, event.partner_changes);
    schedule(p);
  }

  void look_again(std::uint32_t p) {
    ++gas_.events.stale;
    expect(p, search_.around(p, gas_.calendar[p].cell, now_));
  }

  void expect(std::uint32_t p, const Contact& contact) {
    Event& event = gas_.calendar[p];
    event.contact_time = contact.time;
    event.partner = contact.partner;
    event.partner_changes = gas_.particles[contact.partner].changes;
    schedule(p);
  }

  HWY_INLINE void schedule(std::uint32_t p) {
    Event& event = gas_.calendar[p];
    const Exit exit = search_.exit(p, event.cell, now_);
    event.time = std::min(event.contact_time, exit.time);
    event.face = choose(event.contact_time <= exit.time, Event::contact, exit.face);
    gas_.calendar.schedule(p);
  }

  void look_ahead() {
    {
      const std::uint32_t p = gas_.calendar.coming(4 * stride);
      __builtin_prefetch(gas_.particles.data() + p, 1, 2);
      __builtin_prefetch(&gas_.calendar[p], 1, 2);
    }
    if (const Event& event = coming(3 * stride); event.face == Event::contact) {
      __builtin_prefetch(gas_.particles.data() + event.partner, 1, 2);
      __builtin_prefetch(&gas_.calendar[event.partner], 1, 2);
      search_.prefetch_bricks_around(event.cell);
    } else {
      search_.prefetch_bricks_beyond(event.cell, event.face);
    }
    if (const Event& event = coming(2 * stride); event.face == Event::contact) {
      search_.prefetch_particles_around(event.cell);
      const Cell partner = gas_.calendar[event.partner].cell;
      if (partner != event.cell) search_.prefetch_bricks_around(partner);
    } else {
      search_.prefetch_particles_beyond(event.cell, event.face);
    }
    if (!huge_) return;
    if (const Event& event = coming(stride);
        event.face == Event::contact && gas_.calendar[event.partner].cell != event.cell)
      search_.prefetch_particles_around(gas_.calendar[event.partner].cell);
  }
  const Event& coming(std::uint32_t places) const {
    return gas_.calendar[gas_.calendar.coming(places)];
  }

  static constexpr std::uint32_t stride = 3;

  Gas& gas_;
  const bool huge_ = gas_.particles.size() > 200000;
  Search search_;
  double e_;
  const double unit_ = gas_.box.side * 0x1p-32;
  float now_;
  std::int64_t collisions_;
};

}  // namespace haff::single
