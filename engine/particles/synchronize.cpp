// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/particles/synchronize.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/collision/pair_geometry.hpp"
#include "engine/particles/spatial_order.hpp"
#include "engine/simulation.hpp"
#include "engine/soundness.hpp"

namespace haff::engine {
namespace {

// Velocities are doubled when the energy per particle has fallen below the first of these, and
// halved when it has risen above the second. They are so far apart that an elastic gas at 1 is
// never scaled. [scaled units]
constexpr double smallest_energy = 0.25;
constexpr double largest_energy = 4;

// Below this energy, squares lose digits, and the scaling factor would overflow.
constexpr double smallest_normal = 1e-290;

// Returns the kinetic energy per particle.
template <class Masses>
double rescale(std::span<Particle> particles, Clock& clock, const Masses& masses) {
  int doublings = 0;
  double energy = kinetic_energy<Masses>(particles, masses);
  if (!std::isfinite(energy)) throw PhysicsError("the kinetic energy is not finite");
  if (energy < smallest_normal) return energy;  // no particle moves
  for (; energy < smallest_energy; energy *= 4) ++doublings;
  for (; energy > largest_energy; energy /= 4) --doublings;
  if (doublings == 0) return energy;
  const double factor = std::ldexp(1.0, doublings);
  for (Particle& p : particles)
    for (double& v : p.velocity) v *= factor;
  clock.exponent += doublings;
  clock.before.virial *= factor;
  clock.before.dissipated *= factor * factor;
  return kinetic_energy<Masses>(particles, masses);
}

double energy_per_particle(double squares, std::size_t particles) {
  return 0.5 * squares / static_cast<double>(particles);
}

// Adds the tally of this period to that of earlier ones. The two are kept apart until then because
// the loss of a late, cold period would vanish beside that of the warm ones before it.
void settle(Clock& clock) {
  clock.before.dissipated += clock.tally.dissipated;
  clock.before.virial += clock.tally.virial;
  clock.tally = {};
}

}  // namespace

template <class Masses>
void audit(std::span<const Particle> particles, Clock& clock, double allowed_overlap,
           const Masses& masses, const Rotation& rotation) {
  const double before = clock.energy + rotation.before;
  const double energy = kinetic_energy(particles, masses) + rotation.now;
  const double lost =
      (clock.taken + clock.tally.dissipated) / static_cast<double>(particles.size());
  const double mismatch = std::abs(before - energy - lost) / before;
  clock.invariants.energy_mismatch = std::max(clock.invariants.energy_mismatch, mismatch);
  const std::optional<std::string> broken = std::isfinite(energy)
                                                ? violation(clock.invariants, allowed_overlap)
                                                : "the kinetic energy is not finite";
  if (broken)
    throw PhysicsError(*broken + ", after " + std::to_string(clock.collisions) + " collisions");
}

template <class Masses>
void start(std::span<Particle> particles, Clock& clock, const Masses& masses) {
  clock.energy = rescale(particles, clock, masses);
}

Tally take_tally(Clock& clock) {
  clock.taken += clock.tally.dissipated;
  settle(clock);
  const Tally scaled = std::exchange(clock.before, {});
  return {.dissipated = std::ldexp(scaled.dissipated, -2 * clock.exponent),
          .virial = std::ldexp(scaled.virial, -clock.exponent)};
}

Vector wrapped(Vector position, const Box& box) {
  for (double& x : position) {
    x -= std::floor(x * box.inverse) * box.side;
    if (x < 0) x += box.side;  // rounding can leave x slightly outside, on either side
    if (x >= box.side) x -= box.side;
  }
  return position;
}

double Clock::time() const {
  return start + std::ldexp(now, exponent);
}

double Clock::scaled(double time) const {
  return std::ldexp(time - start, -exponent);
}

template <class Masses>
void synchronize(std::span<Particle> particles, Clock& clock, const Box& box, const Masses& masses,
                 Team& team) {
  team.for_parts(particles.size(), [&](std::size_t begin, std::size_t end) {
    for (Particle& p : particles.subspan(begin, end - begin)) {
      advance(p, clock.now);
      p.position = wrapped(p.position, box);
      p.time = 0;
      p.changes = 0;
    }
  });
  settle(clock);
  clock.taken = 0;
  clock.start = clock.time();
  clock.now = 0;
  // Relative to the speeds at the beginning of the period, when most of the rounding occurred.
  const double slowed =
      clock.energy > 0 ? std::sqrt(kinetic_energy<Masses>(particles, masses) / clock.energy) : 1;
  const double momentum = remove_momentum(particles, masses) * std::min(slowed, 1.0);
  clock.invariants.momentum_removed = std::max(clock.invariants.momentum_removed, momentum);
  sort_in_space(particles, box, team);
  start(particles, clock, masses);  // sums run in the new order, as in a run that is resumed here
}

template <class Masses>
double remove_momentum(std::span<Particle> particles, const Masses& masses) {
  Vector total{};
  for (const Particle& p : particles)
    for (std::size_t k = 0; k < 3; ++k) total[k] += masses.of(p) * p.velocity[k];
  const double mass = masses.of_all(particles.size());
  const Vector drift{total[0] / mass, total[1] / mass, total[2] / mass};
  double squares = 0;  // of all velocities, times the masses
  for (Particle& p : particles) {
    for (std::size_t k = 0; k < 3; ++k) p.velocity[k] -= drift[k];
    squares += masses.of(p) * dot(p.velocity, p.velocity);
  }
  const double energy = energy_per_particle(squares, particles.size());
  return energy > 0 ? std::sqrt(dot(total, total) / (mass * 2 * energy)) : 0;
}

template <class Masses>
double kinetic_energy(std::span<const Particle> particles, const Masses& masses) {
  double sum = 0;
  for (const Particle& p : particles) sum += masses.of(p) * dot(p.velocity, p.velocity);
  return energy_per_particle(sum, particles.size());
}

State to_state(std::span<const Particle> particles, const Clock& clock, const Box& box) {
  State state;
  state.d = box.d;
  state.box = box.side;
  for (const Particle& p : particles) {
    state.id.push_back(p.id);
    state.position.push_back(p.position);
    state.velocity.push_back(p.velocity);
  }
  state.exponent = clock.exponent;
  state.collisions = clock.collisions;
  state.time = clock.start;
  state.tally = clock.before;
  state.invariants = clock.invariants;
  return state;
}

void copy_particles(const State& state, std::span<Particle> particles) {
  for (std::size_t k = 0; k < particles.size(); ++k)
    particles[k] = {state.position[k], 0, state.velocity[k], state.id[k], 0};
}

Clock to_clock(const State& state) {
  Clock clock;
  clock.collisions = state.collisions;
  clock.start = state.time;
  clock.exponent = state.exponent;
  clock.before = state.tally;
  clock.invariants = state.invariants;
  return clock;
}

std::int64_t next_at(std::int64_t collisions, std::size_t particles, double period, double phase) {
  const auto passed = static_cast<std::int64_t>(2.0 * static_cast<double>(collisions) /
                                                (period * static_cast<double>(particles)));
  for (std::int64_t k = std::max<std::int64_t>(passed - 1, 0);; ++k) {
    const auto at = collisions_at(period * (static_cast<double>(k) + phase),
                                  static_cast<std::uint32_t>(particles));
    if (at > collisions) return at;
  }
}

std::int64_t next_synchronization(std::int64_t collisions, std::size_t particles) {
  return next_at(collisions, particles, synchronization_period);
}

template void start(std::span<Particle>, Clock&, const EqualMasses&);
template void audit(std::span<const Particle>, Clock&, double, const EqualMasses&, const Rotation&);
template void synchronize(std::span<Particle>, Clock&, const Box&, const EqualMasses&, Team&);
template double remove_momentum(std::span<Particle>, const EqualMasses&);
template double kinetic_energy(std::span<const Particle>, const EqualMasses&);

template void start(std::span<Particle>, Clock&, const MixedMasses&);
template void audit(std::span<const Particle>, Clock&, double, const MixedMasses&, const Rotation&);
template void synchronize(std::span<Particle>, Clock&, const Box&, const MixedMasses&, Team&);
template double remove_momentum(std::span<Particle>, const MixedMasses&);
template double kinetic_energy(std::span<const Particle>, const MixedMasses&);

}  // namespace haff::engine
