// SPDX-License-Identifier: GPL-3.0-or-later

// What happens when two smooth particles touch.
//
// Model of R. Kawahara and H. Nakanishi, cond-mat/0309130: equal spheres, sigma = m = 1.
// At contact, with the unit vector n along the relative position and restitution e,
//   v_a* = v_a - (1+e)/2 [n.(v_a - v_b)] n,   v_b* = v_b + the same.
// For particles of masses m_a and m_b with the reduced mass mu,
//   v_a* = v_a - (mu/m_a) (1+e) [n.(v_a - v_b)] n,   v_b* = v_b + (mu/m_b) (the same),
// and the energy (mu/2) (1 - e^2) [n.(v_a - v_b)]^2 is lost.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "engine/collision/pair_geometry.hpp"
#include "engine/collision/record_halves.hpp"
#include "engine/particles/clock.hpp"
#include "engine/restitution/restitution_model.hpp"

namespace haff::engine {

// The reduced mass mu = m_a m_b / (m_a + m_b) of a pair, and mu/m_a and mu/m_b, the shares of a
// change of the relative velocity that the particles take. For equal masses all three are 1/2, as
// the compiler knows.
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

// The collision of two smooth particles. The restitution model decides e.
template <class RestitutionModel, class PairGeometry = HardSpheres>
class SmoothCollision : public PairGeometry {
 public:
  explicit SmoothCollision(RestitutionModel restitution, PairGeometry geometry = PairGeometry())
      : PairGeometry(std::move(geometry)), restitution_(std::move(restitution)) {}

  // Lets a and b collide at the time `now`. Adds the lost energy and the virial to the clock's
  // tally, in the units of the scaled velocities. Returns r.v before the collision, which is
  // negative.
  template <class AnyClock>
  [[gnu::always_inline]] double collide(Particle& a, Particle& b, double now, const Box& box,
                                        AnyClock& clock) const {
    return resolve(a, b, now, box, clock).approach;
  }

  // The memory of the restitution model (restitution_model.hpp) and of the geometry.
  void recall(const State& state) {
    PairGeometry::recall(state);
    restitution_.recall(state);
  }
  void store(State& state) const {
    PairGeometry::store(state);
    restitution_.store(state);
  }
  void before_synchronization(std::span<const Particle> particles, double now) {
    restitution_.before_synchronization(particles, now);
  }
  void scale(int exponent) { restitution_.scale(exponent); }

  // The data beside the records that a collision changes, to undo it: none.
  struct Memento {};
  static Memento memento(const Particle&, const Particle&) { return {}; }
  static void restore(const Memento&) {}

  // Smooth particles have no rotation and no data beside their records.
  static std::optional<Rotation> rotation() { return std::nullopt; }
  static std::size_t memory() { return 0; }  // bytes

 protected:
  // The pair at its contact, before the collision.
  struct Meeting {
    Four r, v;        // of b relative to a
    double approach;  // r.v
    double distance2;
  };

  template <class AnyClock>
  [[gnu::always_inline]] Meeting resolve(Particle& a, Particle& b, double now, const Box& box,
                                         AnyClock& clock) const {
    RecordHalves of_a(a, now), of_b(b, now);
    Four r = of_b.position - of_a.position;
    to_nearest_image(r, box);
    const Four v = of_b.velocity - of_a.velocity;
    const double approach = dot(r, v);
    const double distance2 = dot(r, r);
    const ReducedMass mass(this->masses(), a, b);
    const double e = restitution_(
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
  RestitutionModel restitution_;
};

}  // namespace haff::engine
