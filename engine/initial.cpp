// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/initial.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "engine/particles/spatial_order.hpp"
#include "engine/particles/synchronize.hpp"
#include "engine/simulation.hpp"
#include "engine/start/growth.hpp"
#include "engine/start/lattice.hpp"
#include "engine/support/random.hpp"

namespace haff::engine {
namespace {

// The cube root by Newton's method from above, where every step decreases the value until rounding
// stops it. std::cbrt is not correctly rounded, and its last bit would end up in the trajectory.
double cube_root(double x) {
  double root = std::max(x, 1.0);
  for (;;) {
    const double next = root - (root - x / (root * root)) / 3;
    if (!(next < root)) return root;
    root = next;
  }
}

template <class Masses>
void set_energy(std::vector<Particle>& particles, double energy, const Masses& masses) {
  const double factor = std::sqrt(energy / kinetic_energy(particles, masses));
  for (Particle& p : particles)
    for (double& v : p.velocity) v *= factor;
}

// Draws Gaussian velocities; all species have the same temperature.
template <class Masses>
void draw_velocities(std::vector<Particle>& particles, std::uint64_t seed, int d,
                     const Masses& masses) {
  Random random(seed, Stream::velocities);
  for (Particle& p : particles)
    for (double& v : std::span(p.velocity).first(static_cast<std::size_t>(d)))
      v = random.normal() / std::sqrt(masses.of(p));
  remove_momentum(particles, masses);
  set_energy(particles, 1, masses);
}

// Puts the species at random places (R. Durstenfeld's shuffle).
void mix(std::vector<Particle>& particles, std::uint64_t seed) {
  Random random(seed, Stream::mixture);
  for (std::size_t k = particles.size() - 1; k > 0; --k)
    std::swap(particles[k].id, particles[random.below(k + 1)].id);
}

Box box_of(double n, std::uint32_t count, int d) {
  return Box(box_side(n, count, d), d);
}

}  // namespace

double box_side(double n, std::uint32_t particles, int d) {
  return d == 2 ? std::sqrt(particles / n) : cube_root(particles / n);
}

bool begins_on_lattice(double n, std::uint32_t particles, int d) {
  return lattice_fits(particles, box_of(n, particles, d));
}

State initial_state(double n, std::uint32_t count, std::uint64_t seed, int d,
                    const std::map<std::string, Parameters>& effects) {
  const Box box = box_of(n, count, d);
  const auto asked = effects.find("mixture");
  const auto mixture =
      asked == effects.end() ? std::nullopt : std::optional(mixture_of(asked->second, count));
  const auto lattice = lattice_positions(count, box);
  const std::vector<Vector> positions =
      lattice ? *lattice : grown_positions(count, box, seed, mixture);
  std::vector<Particle> particles(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    particles[k].position = positions[k];
    particles[k].id = k;
  }
  if (!mixture) {
    draw_velocities(particles, seed, d, EqualMasses{});
    sort_in_space(particles, box);
    return to_state(particles, Clock{}, box);
  }
  if (lattice) mix(particles, seed);  // grown particles are already where their size fits
  draw_velocities(particles, seed, d, MixedMasses{*mixture});
  sort_in_space(particles, box);
  State state = to_state(particles, Clock{}, box);
  note(*mixture, state);
  return state;
}

State restarted(const State& state) {
  const Box box(state);
  std::vector<Particle> particles(state.id.size());
  copy_particles(state, particles);
  const auto mixture = mixture_in(state);
  if (!mixture) {
    set_energy(particles, 1, EqualMasses{});
    return to_state(particles, Clock{}, box);
  }
  set_energy(particles, 1, MixedMasses{*mixture});
  State start = to_state(particles, Clock{}, box);
  note(*mixture, start);
  return start;
}

}  // namespace haff::engine
