// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/loop/watchdog.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "engine/collision/pair_geometry.hpp"

namespace haff::engine {
namespace {

// A particle that is closer than this to a member of a collapsed group belongs to it. [sigma]
constexpr double touching = 1e-6;

// The largest number of particles that the message names.
constexpr std::size_t most_named = 12;

bool touch(const Gas& gas, const Particle& a, const Particle& b) {
  Particle x = a, y = b;
  advance(x, gas.clock.now);
  advance(y, gas.clock.now);
  const Encounter pair(x, y, gas.clock.now, gas.box);
  const double reach =
      (1 + touching) * (gas.mixture ? gas.mixture->contact_distance(a.id, b.id) : 1);
  return dot(pair.r, pair.r) < reach * reach;
}

// The two particles, and all particles that touch them directly or through others.
std::vector<std::uint32_t> group_around(const Gas& gas, std::uint32_t p, std::uint32_t q) {
  std::vector<std::uint32_t> group{p, q};
  for (std::size_t k = 0; k < group.size() && group.size() < most_named; ++k)
    for (std::uint32_t other = 0; other < gas.particles.size(); ++other)
      if (std::find(group.begin(), group.end(), other) == group.end() &&
          touch(gas, gas.particles[group[k]], gas.particles[other]))
        group.push_back(other);
  return group;
}

std::string named(const std::vector<std::uint32_t>& ids) {
  std::string text;
  for (std::size_t k = 0; k < std::min(ids.size(), most_named); ++k)
    text += (k == 0 ? "" : k + 1 == ids.size() ? " and " : ", ") + std::to_string(ids[k]);
  return ids.size() > most_named ? text + " and others" : text;
}

Collapse collapse_of(const Gas& gas, std::uint32_t p, std::uint32_t q) {
  std::vector<std::uint32_t> ids;
  for (const std::uint32_t member : group_around(gas, p, q))
    ids.push_back(gas.particles[member].id);
  std::sort(ids.begin(), ids.end());
  Particle at = gas.particles[p];
  advance(at, gas.clock.now);
  const Vector place = wrapped(at.position, gas.box);
  const double tau =
      2.0 * static_cast<double>(gas.clock.collisions) / static_cast<double>(gas.particles.size());
  char where[160];
  std::snprintf(where, sizeof where, "around (%.4g, %.4g, %.4g) at tau = %.6g", place[0], place[1],
                place[2], tau);
  return {"inelastic collapse of particles " + named(ids) + " " + where, ids, place,
          gas.clock.collisions};
}

}  // namespace

double longest_period(std::uint32_t particles) {
  return 100 + 1e6 / particles;
}

double expected_period(const Gas& gas) {
  const double count = static_cast<double>(gas.particles.size());
  const double density = count / gas.box.volume();
  const double temperature = 2.0 / gas.box.d * gas.clock.energy;
  double rate = (gas.box.d == 2 ? 2 : 4) * density * std::sqrt(std::numbers::pi * temperature);
  if (gas.mixture)
    rate *=
        relative_rate(*gas.mixture, gas.box.d, static_cast<std::uint32_t>(gas.particles.size()));
  return synchronization_period / rate;
}

void note_slow_collision(Gas& gas, std::uint32_t p, std::uint32_t q, double since) {
  if (gas.clock.now - since > quick_succession * expected_period(gas)) return;
  if (++gas.clock.invariants.unresolved_collisions >= unresolved_collisions_of_a_collapse)
    throw collapse_of(gas, p, q);
}

void must_have_progressed(const Gas& gas, double expected) {
  if (gas.clock.now > stalled_period * expected) return;
  // The two particles that collided most often.
  std::uint32_t first = 0, second = 1;
  for (std::uint32_t p = 0; p < gas.particles.size(); ++p) {
    if (gas.particles[p].changes > gas.particles[first].changes) {
      second = first;
      first = p;
    } else if (p != first && gas.particles[p].changes > gas.particles[second].changes) {
      second = p;
    }
  }
  throw collapse_of(gas, first, second);
}

}  // namespace haff::engine
