// When two spheres touch, and what happens then.
//
// Model of R. Kawahara and H. Nakanishi, cond-mat/0309130: equal spheres, sigma = m = 1.
// At contact, with unit vector n along the relative position and restitution e,
//   v_a* = v_a - (1+e)/2 [n.(v_a - v_b)] n,   v_b* = v_b + the same.
//
// The scalar functions here define the trajectory to the last bit; the SIMD search repeats their
// operations one for one. They use + - * / sqrt and rounding to an integer only, all exact or
// correctly rounded on every machine, and are exactly symmetric in a and b: swapping the two
// negates every intermediate vector, and IEEE negation is exact.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/particle.hpp"

namespace haff::engine {

inline constexpr double never = std::numeric_limits<double>::infinity();

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

// Gives a and b, in contact now, the momentum impulse * r and -impulse * r.
[[gnu::always_inline]] inline void exchange(Particle& a, Particle& b, const Encounter& contact,
                                            double impulse) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double change = impulse * contact.r[k];
    a.velocity[k] += change;
    b.velocity[k] -= change;
  }
  ++a.changes;
  ++b.changes;
}

// Smooth spheres with a constant restitution coefficient.
struct InelasticSpheres {
  double restitution;  // e

  // Time at which a and b touch, or never. Overlapping pairs that approach (rounding makes them, by
  // some 1e-16) touch at once; pairs that separate do not touch at all.
  double contact_time(const Encounter& pair) const {
    const double approach = dot(pair.r, pair.v);
    const double gap = dot(pair.r, pair.r) - 1;
    const double discriminant = approach * approach - dot(pair.v, pair.v) * gap;
    if (!(approach < 0 && discriminant >= 0)) return never;
    // The root written so that it does not cancel when the pair is close.
    return pair.start + std::max(gap, 0.0) / (std::sqrt(discriminant) - approach);
  }

  // Lets a and b collide `now`. Adds loss and virial, in the units of the scaled velocities.
  [[gnu::always_inline]] void collide(Particle& a, Particle& b, double now, const Box& box,
                                      Tally& tally) const {
    advance(a, now);
    advance(b, now);
    const Encounter contact(a, b, now, box);
    const double approach = dot(contact.r, contact.v);
    const double distance2 = dot(contact.r, contact.r);
    exchange(a, b, contact, 0.5 * (1 + restitution) * approach / distance2);
    tally.virial -= 0.5 * (1 + restitution) * approach;
    tally.dissipated += 0.25 * (1 - restitution * restitution) * approach * approach / distance2;
  }
};

}  // namespace haff::engine
