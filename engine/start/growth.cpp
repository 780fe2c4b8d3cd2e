// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/start/growth.hpp"

#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

#include "engine/loop/event_loop-inl.hpp"
#include "engine/support/random.hpp"

namespace haff::engine {
namespace {

// The stage of growth is given by the diameter of the largest spheres, which grows from 0 to sigma.

// d(diameter)/dt, in units of the thermal speed: slow enough to reach random close packing, and
// fast enough to avoid crystallization on the way.
constexpr double growth_rate = 0.02;
// The spheres are jammed if they collide so often that they grow by less than this between two
// synchronizations. [sigma]
constexpr double least_growth = 1e-5;

// Elastic spheres that have grown to the fraction `diameter` + growth_rate * (time since the
// synchronization) of their final size.
struct GrowingSpheres {
  double diameter;
  Mixture sizes;  // when full-grown

  double contact_time(const Encounter& pair, const Particle& a, const Particle& b) const {
    const double size = sizes.contact_distance(a.id, b.id);
    const double rate = growth_rate * size;
    const double wide = (diameter + growth_rate * pair.start) * size;
    const double approach = dot(pair.r, pair.v) - wide * rate;
    const double speed2 = dot(pair.v, pair.v) - rate * rate;
    const double gap = dot(pair.r, pair.r) - wide * wide;
    const double discriminant = approach * approach - speed2 * gap;
    // A pair that separates more slowly than the spheres grow also touches.
    if (!((approach < 0 || (speed2 < 0 && gap > 0)) && discriminant >= 0)) return never;
    return pair.start + std::max(gap, 0.0) / (std::sqrt(discriminant) - approach);
  }

  double collide(Particle& a, Particle& b, double now, const Box& box, Clock&) const {
    advance(a, now);
    advance(b, now);
    const Encounter contact(a, b, now, box);
    const double distance2 = dot(contact.r, contact.r);
    // Reflected in the frame of the surfaces, which move at the rate at which the two grow.
    const double rate = growth_rate * sizes.contact_distance(a.id, b.id);
    const double change = dot(contact.r, contact.v) / distance2 - rate / std::sqrt(distance2);
    for (std::size_t k = 0; k < 3; ++k) {
      a.velocity[k] += change * contact.r[k];
      b.velocity[k] -= change * contact.r[k];
    }
    ++a.changes;
    ++b.changes;
    return -1;  // growth drives the pair apart, so that the watchdog need not count this collision
  }
};

template <class Candidates, int d>
using Loop = HWY_NAMESPACE::EventLoop<PlainSearch<GrowingSpheres, Candidates, d>, GrowingSpheres>;

State random_points(std::uint32_t count, const Box& box, std::uint64_t seed) {
  Random random(seed, Stream::growth);
  State state;
  state.d = box.d;
  state.box = box.side;
  for (std::uint32_t k = 0; k < count; ++k) {
    state.id.push_back(k);
    state.position.emplace_back();
    state.velocity.emplace_back();
    const auto axes = static_cast<std::size_t>(box.d);
    for (double& x : std::span(state.position.back()).first(axes)) x = random.uniform() * box.side;
    for (double& v : std::span(state.velocity.back()).first(axes)) v = random.normal();
  }
  return state;
}

// Growth heats the gas: this scales its thermal speed back to 1.
void cool(Gas& gas) {
  const double factor = 1 / std::sqrt(kinetic_energy(gas.particles));
  for (Particle& p : gas.particles)
    for (double& v : p.velocity) v *= factor;
}

// Runs until the next synchronization, or until the spheres are full-grown.
template <class Candidates, int d>
void grow_among(Gas& gas, GrowingSpheres spheres, std::int64_t collisions) {
  Loop<Candidates, d> loop(gas, spheres);
  loop.predict_all();
  loop.run(collisions, (1 - spheres.diameter) / growth_rate);
}

template <int d>
void grow(Gas& gas, const GrowingSpheres& spheres, std::int64_t collisions) {
  if (!Bricks::fits(gas.box))
    grow_among<AllParticlesAllImages, d>(gas, spheres, collisions);
  else if (!gas.bricks.tell_images_apart())
    grow_among<NearbyAllImages, d>(gas, spheres, collisions);
  else
    grow_among<NearbyNearestImage, d>(gas, spheres, collisions);
}

void grow_to_full_size(Gas& gas, const Mixture& sizes) {
  for (double diameter = 0; diameter < 1;) {
    cool(gas);
    prepare(gas);
    const auto count = static_cast<std::uint32_t>(gas.particles.size());
    const std::int64_t stop = next_synchronization(gas.clock.collisions, count);
    if (gas.box.d == 2)
      grow<2>(gas, {diameter, sizes}, stop);
    else
      grow<3>(gas, {diameter, sizes}, stop);
    const double growth = growth_rate * gas.clock.now;
    const bool full_grown = gas.clock.collisions < stop;  // stopped by time
    if (!full_grown && growth < least_growth)
      throw std::invalid_argument("spheres grown into a box of side " +
                                  std::to_string(gas.box.side) + " jammed at diameter " +
                                  std::to_string(diameter) + ": n is too high");
    diameter = full_grown ? 1 : diameter + growth;
    synchronize(gas.particles, gas.clock, gas.box);
  }
}

}  // namespace

std::vector<Vector> grown_positions(std::uint32_t count, const Box& box, std::uint64_t seed,
                                    const std::optional<Mixture>& mixture) {
  Gas gas(random_points(count, box, seed));
  grow_to_full_size(gas, mixture.value_or(Mixture{}));  // without one, all sizes are 1
  std::vector<Vector> positions(count);
  for (const Particle& p : gas.particles) positions[p.id] = p.position;
  return positions;
}

}  // namespace haff::engine
