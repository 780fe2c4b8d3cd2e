// SPDX-License-Identifier: GPL-3.0-or-later

// When two spheres touch.
//
// States that rounding has made slightly invalid are handled as in M. N. Bannerman, S. Strobl,
// A. Formella, T. Poeschel, Comp. Part. Mech. 1, 191 (2014), arXiv:1211.6718. With the overlap
// function f = r^2 - sigma^2, the event of a pair is not a root of f but the first moment at which
//   f <= 0 and df/dt < 0:
// the spheres touch or overlap, and approach each other. For a valid state this moment is the root.
// A pair that overlaps and approaches has its event at once; a pair that overlaps and separates has
// none until it has come apart. So an overlap never grows, no root is used twice, and none lies in
// the past; and since df/dt >= 0 after a collision, a collision always ends the event that caused
// it. Three choices remain:
//   - df/dt = 2 r.v is known only up to rounding. Below `smallest_approach` it counts as zero.
//     Otherwise a contact after which r.v should be 0 (e = 0, or a grazing contact) would return
//     again and again at the same instant whenever rounding makes r.v -1e-17, and change nothing.
//   - The partner's image is the nearest one at the time `now`, so a contact across a face of the
//     box is found from either side.
//   - No time is compared with the rounding error of another one: events are ordered by
//     (time, ids) alone.
// The watchdog (loop/watchdog.hpp) makes sure, by counting, that the event loop makes progress.
//
// The scalar functions here define the trajectory to the last bit; the SIMD search repeats their
// operations one for one. They use only + - * / sqrt and rounding to an integer, which are exact or
// correctly rounded on every machine. They are exactly symmetric in a and b: exchanging the two
// negates every intermediate vector, and IEEE negation is exact.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/particles/box.hpp"
#include "engine/particles/masses.hpp"
#include "engine/particles/particle.hpp"

namespace haff::engine {

inline constexpr double never = std::numeric_limits<double>::infinity();

// r.v of a pair in contact is a sum of three products of numbers of order one, each known to 2^-53.
// Speeds in scaled units are below 10, so the error of the sum is some 1e-15, a tenth of this
// limit. An approach that is truly so slow has a probability of 1e-28 per collision. With a larger
// limit, resting spheres would sink into each other by this much per unit of time; with a smaller
// one, contacts at e = 0 would repeat without end. [sigma * scaled speed]
inline constexpr double smallest_approach = 0x1p-46;

inline double dot(const Vector& a, const Vector& b) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

// Position and velocity of b relative to a at `start`, the later of the times of their records. Of
// the images of b, this takes the one that is nearest to a at the time `now`, displaced by `image`
// boxes. The result is a function of the two records and the image alone.
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

// The pair geometry of equal spheres or disks of diameter sigma and mass m. A pair geometry says
// when two particles touch and what masses they have; two_species.hpp is that of a binary mixture.
struct HardSpheres {
  // The time at which the particles touch, or `never`.
  static double contact_time(const Encounter& pair, const Particle&, const Particle&) {
    const double approach = dot(pair.r, pair.v);
    const double gap = dot(pair.r, pair.r) - 1;
    const double discriminant = approach * approach - dot(pair.v, pair.v) * gap;
    if (!(approach < -smallest_approach && discriminant >= 0)) return never;
    // This form of the root does not cancel when the pair is close.
    return pair.start + std::max(gap, 0.0) / (std::sqrt(discriminant) - approach);
  }
  // The squared distance of the centres at contact.
  static constexpr double contact2(const Particle&, const Particle&) { return 1; }
  // The effective radius relative to that of a pair of species 1 (Impact).
  static constexpr double effective_radius(const Particle&, const Particle&) { return 1; }
  static EqualMasses masses() { return {}; }

  // A state of equal particles needs no memory.
  void recall(const State&) {}
  void store(State&) const {}
};

}  // namespace haff::engine
