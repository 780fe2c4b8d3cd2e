// When two spheres touch, and what happens then.
//
// Model of R. Kawahara and H. Nakanishi, cond-mat/0309130: equal spheres, sigma = m = 1.
// At contact, with unit vector n along the relative position and restitution e,
//   v_a* = v_a - (1+e)/2 [n.(v_a - v_b)] n,   v_b* = v_b + the same.
//
// States that rounding has made slightly invalid are dealt with as in M. N. Bannerman, S. Strobl,
// A. Formella, T. Poeschel, Comp. Part. Mech. 1, 191 (2014), arXiv:1211.6718. With the overlap
// function f = r^2 - sigma^2, a pair's event is not a root of f but the first moment at which
//   f <= 0 and df/dt < 0:
// spheres that are to come closer are in contact or overlap. For a valid state that is the root.
// An overlapping pair that approaches has its event at once, one that separates has none until it
// has come apart: so an overlap never grows, no root is taken twice, none in the past, and a
// collision, after which df/dt >= 0, always ends the event that caused it. What is left to decide:
//   - df/dt = 2 r.v is known only to its rounding. Below `smallest_approach` it counts as zero.
//     Otherwise a contact after which r.v should be 0 (e = 0, or grazing) would come again and
//     again at the same instant, whenever rounding makes it -1e-17, and change nothing.
//   - The image of the partner is the nearest one `now`: a contact across a face is found from
//     either side.
//   - No time is compared with another one's rounding: events are ordered by (time, ids) alone.
// That the loop goes on is watched by counting (watchdog.hpp), not hoped for.
//
// The scalar functions here define the trajectory to the last bit; the SIMD search repeats their
// operations one for one. They use + - * / sqrt and rounding to an integer only, all exact or
// correctly rounded on every machine, and are exactly symmetric in a and b: swapping the two
// negates every intermediate vector, and IEEE negation is exact.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "engine/clock.hpp"
#include "engine/halves.hpp"
#include "engine/masses.hpp"
#include "engine/particle.hpp"

namespace haff::engine {

inline constexpr double never = std::numeric_limits<double>::infinity();

// r.v of a pair in contact is a sum of three products of numbers of order one, each known to
// 2^-53: speeds in scaled units are below 10, so the sum is good to some 1e-15, a tenth of this. A
// real approach as slow has one chance in 1e28 per collision. Were it larger, resting spheres would
// sink into each other by it in a unit of time; smaller, and contacts at e = 0 repeat without end.
// [sigma * scaled speed]
inline constexpr double smallest_approach = 0x1p-46;

inline double dot(const Vector& a, const Vector& b) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

// b relative to a at the later of their two times, `start`: that image of b is taken which is
// nearest to a `now`, displaced by `image` boxes. A function of the two records and the image
// alone.
struct Encounter {
  [[gnu::always_inline]] Encounter(const Particle& a, const Particle& b, double now, const Box& box,
                                   const Vector& image = {0, 0, 0})
      : start(std::max(a.time, b.time)) {
    for (std::size_t k = 0; k < 3; ++k) {
      r[k] = (b.position[k] + b.velocity[k] * (start - b.time)) -
             (a.position[k] + a.velocity[k] * (start - a.time));
      v[k] = b.velocity[k] - a.velocity[k];
      const double boxes = std::rint((r[k] + v[k] * (now - start)) * box.inverse);
      r[k] -= (boxes + image[k]) * box.side;
    }
  }

  double start;
  Vector r;
  Vector v;
};

[[gnu::always_inline]] inline void advance(Particle& p, double now) {
  for (std::size_t k = 0; k < 3; ++k) p.position[k] += p.velocity[k] * (now - p.time);
  p.time = now;
}

// Spheres, or disks, of diameter sigma and mass m: what bodies say of themselves. Those of two
// species say the same in two_species.hpp.
struct HardSpheres {
  // Time at which the two touch, or never.
  static double contact_time(const Encounter& pair, const Particle&, const Particle&) {
    const double approach = dot(pair.r, pair.v);
    const double gap = dot(pair.r, pair.r) - 1;
    const double discriminant = approach * approach - dot(pair.v, pair.v) * gap;
    if (!(approach < -smallest_approach && discriminant >= 0)) return never;
    // The root written so that it does not cancel when the pair is close.
    return pair.start + std::max(gap, 0.0) / (std::sqrt(discriminant) - approach);
  }
  // Squared distance in contact.
  static constexpr double contact2(const Particle&, const Particle&) { return 1; }
  // See Impact.
  static constexpr double effective_radius(const Particle&, const Particle&) { return 1; }
  static EqualMasses masses() { return {}; }

  // Of whom a state is.
  void recall(const State&) {}
  void store(State&) const {}
};

// The reduced mass mu = m_a m_b / (m_a + m_b) of two that meet, and its parts mu/m_a, mu/m_b: what
// a change of their relative velocity is to each. Of equal masses all are 1/2, known beforehand.
struct ReducedMass {
  template <class Masses>
  [[gnu::always_inline]] ReducedMass(const Masses& masses, const Particle& a, const Particle& b) {
    const double both = masses.of(a) + masses.of(b);
    value = masses.of(a) * masses.of(b) / both;
    in_a = masses.of(b) / both;
    in_b = masses.of(a) / both;
  }
  double value, in_a, in_b;
};

// What a law of restitution (laws.hpp) may know of a collision.
struct Impact {
  const Particle& a;  // as they were after their last collisions (none if their `changes` are 0)
  const Particle& b;
  double now;
  double speed2;  // of approach along the normal, squared, in scaled units
  // Effective radius sigma_a sigma_b / (sigma_a + sigma_b) and reduced mass of the pair, in those
  // of a pair of species 1: what the strength of a law of one material depends on.
  double radius;
  double mass;
};

// Smooth bodies; the law says with which e two of them part. In general
//   v_a* = v_a - (mu/m_a) (1+e) [n.(v_a - v_b)] n,   v_b* = v_b + (mu/m_b) (the same),
// which loses (mu/2) (1 - e^2) [n.(v_a - v_b)]^2.
template <class Law, class Bodies = HardSpheres>
class SmoothSpheres : public Bodies {
 public:
  explicit SmoothSpheres(Law law, Bodies bodies = Bodies())
      : Bodies(std::move(bodies)), law_(std::move(law)) {}

  // Lets a and b collide `now`. Adds loss and virial, in the units of the scaled velocities.
  // Returns r.v before, which is negative.
  [[gnu::always_inline]] double collide(Particle& a, Particle& b, double now, const Box& box,
                                        Clock& clock) const {
    return part(a, b, now, box, clock).approach;
  }

  // What the law remembers (law.hpp), and the bodies.
  void recall(const State& state) {
    Bodies::recall(state);
    law_.recall(state);
  }
  void store(State& state) const {
    Bodies::store(state);
    law_.store(state);
  }
  void before_synchronization(std::span<const Particle> particles, double now) {
    law_.before_synchronization(particles, now);
  }
  void scale(int exponent) { law_.scale(exponent); }

  // Nothing that turns, and nothing beside the records.
  static std::optional<Rotation> rotation() { return std::nullopt; }
  static std::size_t memory() { return 0; }  // bytes

 protected:
  struct Parting {
    Four r, v;        // b relative to a, as they came
    double approach;  // r.v
    double distance2;
  };

  [[gnu::always_inline]] Parting part(Particle& a, Particle& b, double now, const Box& box,
                                      Clock& clock) const {
    Halves of_a(a, now), of_b(b, now);
    Four r = of_b.position - of_a.position;
    to_nearest_image(r, box);
    const Four v = of_b.velocity - of_a.velocity;
    const double approach = dot(r, v);
    const double distance2 = dot(r, r);
    const ReducedMass mass(this->masses(), a, b);
    const double e = law_(
        {a, b, now, approach * approach / distance2, this->effective_radius(a, b), 2 * mass.value});
    of_a.velocity += mass.in_a * (1 + e) * approach / distance2 * r;
    of_b.velocity -= mass.in_b * (1 + e) * approach / distance2 * r;
    of_a.write(a);
    of_b.write(b);
    clock.tally.virial -= mass.value * (1 + e) * approach;
    clock.tally.dissipated += 0.5 * mass.value * (1 - e * e) * approach * approach / distance2;
    clock.invariants.closest2 =
        std::min(clock.invariants.closest2, distance2 / this->contact2(a, b));
    return {r, v, approach, distance2};
  }

 private:
  Law law_;
};

}  // namespace haff::engine
