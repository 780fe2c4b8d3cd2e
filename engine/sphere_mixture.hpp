// Spheres of a binary mixture (mixture.hpp): how they touch, and what a collision does.
//
// Spheres a and b touch at a distance sigma_ab = (sigma_a + sigma_b)/2. With restitution e, the
// reduced mass mu = m_a m_b / (m_a + m_b) and n the unit vector along their relative position,
//   v_a* = v_a - (mu/m_a) (1+e) [n.(v_a - v_b)] n,   v_b* = v_b + (mu/m_b) (the same),
// which loses (mu/2) (1 - e^2) [n.(v_a - v_b)]^2. With equal spheres every bit is as in
// contact.hpp.
#pragma once

#include "engine/any_law.hpp"
#include "engine/mixture.hpp"

namespace haff::engine {

// When two of them touch.
class SpheresOfTwoSizes {
 public:
  explicit SpheresOfTwoSizes(const Mixture& mixture) : mixture_(mixture) {}

  double contact_time(const Encounter& pair, const Particle& a, const Particle& b) const {
    const double approach = dot(pair.r, pair.v);
    const double gap = dot(pair.r, pair.r) - contact2(a, b);
    const double discriminant = approach * approach - dot(pair.v, pair.v) * gap;
    if (!(approach < -smallest_approach && discriminant >= 0)) return never;
    return pair.start + std::max(gap, 0.0) / (std::sqrt(discriminant) - approach);
  }

 protected:
  // Squared distance in contact.
  double contact2(const Particle& a, const Particle& b) const {
    const double distance = mixture_.contact_distance(a.id, b.id);
    return distance * distance;
  }

  Mixture mixture_;
};

class SphereMixture : public SpheresOfTwoSizes, public OneOfAKind {
 public:
  SphereMixture(const Model& model, std::uint32_t particles)
      : SpheresOfTwoSizes(mixture_of(model.effects.at("mixture"), particles)), law_(model) {}

  [[gnu::always_inline]] double collide(Particle& a, Particle& b, double now, const Box& box,
                                        Clock& clock) const {
    const double a_time = a.time;
    const double b_time = b.time;
    advance(a, now);
    advance(b, now);
    const Encounter contact(a, b, now, box);
    const double approach = dot(contact.r, contact.v);
    const double distance2 = dot(contact.r, contact.r);
    const double e = law_({a, b, a_time, b_time, now, approach * approach / distance2});
    const double a_mass = mixture_.mass_of(a.id);
    const double b_mass = mixture_.mass_of(b.id);
    const double both = a_mass + b_mass;
    const double reduced = a_mass * b_mass / both;
    const double a_impulse = b_mass / both * (1 + e) * approach / distance2;
    const double b_impulse = a_mass / both * (1 + e) * approach / distance2;
    for (std::size_t k = 0; k < 3; ++k) {
      a.velocity[k] += a_impulse * contact.r[k];
      b.velocity[k] -= b_impulse * contact.r[k];
    }
    ++a.changes;
    ++b.changes;
    clock.tally.virial -= reduced * (1 + e) * approach;
    clock.tally.dissipated += 0.5 * reduced * (1 - e * e) * approach * approach / distance2;
    clock.invariants.closest2 = std::min(clock.invariants.closest2, distance2 / contact2(a, b));
    return approach;
  }

  MixedMasses masses() const { return {mixture_}; }

  void recall(const State& state) {
    law_.recall(state);
    if (mixture_in(state) != mixture_)
      throw std::invalid_argument("the state is not of the mixture that the model asks for");
  }
  void store(State& state) const {
    law_.store(state);
    note(mixture_, state);
  }
  void before_synchronization(std::span<const Particle> particles, double now) {
    law_.before_synchronization(particles, now);
  }
  void scale(int exponent) { law_.scale(exponent); }

 private:
  AnyLaw law_;
};

}  // namespace haff::engine
