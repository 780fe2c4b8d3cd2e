// SPDX-License-Identifier: GPL-3.0-or-later

// The special cases of tests/engine/corners.cpp in gases that are divided among threads: they have
// the same bits as on one thread, which is compared with the naive reference there.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "engine/initial.hpp"
#include "engine/simulation.hpp"
#include "engine/support/random.hpp"
#include "support/gas.hpp"

using namespace haff::engine;
using namespace haff::tests;

namespace {

void check_same(const Simulation& one, const Simulation& several) {
  REQUIRE(several.collisions() == one.collisions());
  REQUIRE(several.time() == one.time());
  REQUIRE(several.velocities() == one.velocities());
  REQUIRE(several.positions() == one.positions());
  REQUIRE(several.invariants() == one.invariants());
}

// Compares one thread with two to four slabs, with windows of random length and random stops, and
// with two real threads, for `tau` collisions per particle.
void agrees(const Model& model, const State& start, double tau) {
  const std::int64_t count = collisions_at(tau, start.particles());
  const std::int64_t last = start.collisions + count;
  Random random(start.particles(), Stream::velocities);
  std::vector<Threads> ways{{.count = 2}};
  for (const unsigned slabs : {2u, 3u, 4u})
    ways.push_back(
        {.count = 1, .slabs = slabs, .window = (1 + 60 * random.uniform()) / start.particles()});
  Simulation one(model, start);
  std::vector<std::unique_ptr<Simulation>> divided;
  for (const Threads& way : ways) {
    divided.push_back(std::make_unique<Simulation>(model, start, SearchBackend::simd, way));
    REQUIRE(divided.back()->windows());
  }
  while (one.collisions() < last) {
    const double stretch = 1 + random.uniform() * static_cast<double>(count) / 3;
    const auto stop = std::min(last, one.collisions() + static_cast<std::int64_t>(stretch));
    one.run_to(stop);
    for (std::size_t k = 0; k < ways.size(); ++k) {
      CAPTURE(ways[k].count);
      CAPTURE(ways[k].slabs);
      CAPTURE(ways[k].window);
      divided[k]->run_to(stop);
      check_same(one, *divided[k]);
    }
  }
  for (const auto& several : divided) CHECK(several->windows()->count > 0);
}

// Sites of a simple cubic lattice, `side` along each axis, `spacing` apart.
std::vector<Vector> cubic(int side, double spacing) {
  std::vector<Vector> sites;
  const auto row = static_cast<std::size_t>(side);
  sites.reserve(row * row * row);
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) sites.push_back({spacing * x, spacing * y, spacing * z});
  return sites;
}

// Room for four slabs of spheres.
constexpr std::uint32_t particles = 16'000;

}  // namespace

// ---- at the same time -------------------------------------------------------------------------

// All collisions of a round have the same time: within slabs, within zones, and across borders.
// (Each collision is the first of all that are left, so that more of them would take long.)
TEST_CASE("threads, corner: a lattice in which all particles collide at once") {
  constexpr int side = 14;
  for (const std::size_t axis : {std::size_t{0}, std::size_t{2}}) {
    CAPTURE(axis);
    const std::vector<Vector> sites = cubic(side, 2);
    std::vector<Vector> velocities(sites.size());
    for (std::size_t k = 0; k < sites.size(); ++k)
      velocities[k][axis] = static_cast<int>(sites[k][axis] / 2) % 2 == 0 ? 1.0 : -1.0;
    for (const double e : {1.0, 0.5})
      agrees({.restitution = e}, state_of(2.0 * side, sites, velocities), 3);
  }
}

// Rods of spheres in contact, along the axis on which the box is cut: all spheres pass on a blow at
// the moment at which they receive it, through every border.
TEST_CASE("threads, corner: Newton's cradles through all borders") {
  constexpr int side = 12;
  constexpr int rod = 30;
  std::vector<Vector> sites, velocities;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < rod; ++z) {
        // The first sphere of each rod comes from below the others.
        sites.push_back({3.0 * x, 3.0 * y, z == 0 ? 0.5 : 2.0 + z});
        velocities.push_back({0, 0, z == 0 ? 1.0 + 0.25 * (x % 3) : 0.0});
      }
  agrees({.restitution = 1}, state_of(3.0 * side, sites, velocities), 4);
}

// ---- borderline contacts ----------------------------------------------------------------------

// Pairs at contact within rounding, in all directions, that separate, rest or approach, and grazing
// pairs, in every cell of slabs and zones.
TEST_CASE("threads, corner: pairs at contact and grazing pairs everywhere") {
  std::vector<Vector> positions, velocities;
  Random random(5, Stream::velocities);
  for (const Vector& site : cubic(16, 4)) {
    const auto axis = static_cast<std::size_t>(random.uniform() * 3);
    const double gap = (std::floor(random.uniform() * 9) - 4) * 0x1p-50;
    const double speeds[] = {1, 1e-8, 0, -1e-8, -1};
    const double speed = speeds[static_cast<std::size_t>(random.uniform() * 5)];
    Vector second = site, drift{}, approach{};
    for (double& v : drift) v = random.uniform() - 0.5;
    second[axis] += 1 + std::max(gap, 0.0);
    approach[random.uniform() < 0.5 ? axis : (axis + 1) % 3] = speed;
    positions.push_back(site);
    positions.push_back(second);
    velocities.push_back(drift);
    for (std::size_t k = 0; k < 3; ++k) approach[k] += drift[k];
    velocities.push_back(approach);
  }
  agrees({.restitution = 0.8}, state_of(64, positions, velocities), 4);
}

// ---- speeds -----------------------------------------------------------------------------------

// In one window the fast particles cross slabs and zones again and again.
TEST_CASE("threads, corner: speeds that differ by 1e8") {
  State state = initial_state(0.1, particles, 2);
  for (std::size_t k = 4; k < state.velocity.size(); ++k)
    for (double& v : state.velocity[k]) v *= 1e-8;
  agrees({.restitution = 0.9}, state, 1);
}

TEST_CASE("threads, corner: all particles but one are at rest") {
  const std::vector<Vector> sites = cubic(16, 2);
  std::vector<Vector> velocities(sites.size());
  velocities[700] = {0.3, 0.1, 1};
  agrees({.restitution = 1}, state_of(32, sites, velocities), 1);
}

// ---- faces ------------------------------------------------------------------------------------

TEST_CASE(
    "threads, corner: particles on the faces of cells and slabs, which cross several at once") {
  // A box of 16.8 has 16 cells along an axis: all particles start on corners of cells, half of them
  // along a diagonal.
  constexpr int side = 16;
  constexpr double spacing = 1.05;
  const State from = initial_state(0.1, side * side * side, 5);
  const std::vector<Vector> sites = cubic(side, spacing);
  std::vector<Vector> velocities = from.velocity;
  for (std::size_t k = 0; k < velocities.size(); k += 2)
    velocities[k] = k % 4 == 0 ? Vector{1, 1, 1} : Vector{-1, -1, -1};
  agrees({.restitution = 0.9}, state_of(spacing * side, sites, velocities), 1);
}

// ---- dense and dilute -------------------------------------------------------------------------

TEST_CASE("threads, corner: bricks that overflow in a crystal near close packing") {
  agrees({.restitution = 1}, initial_state(1.38, 2 * particles, 1), 1);
}

TEST_CASE("threads, corner: a very dilute gas") {
  agrees({.restitution = 0.9}, initial_state(1e-4, particles, 1), 0.3);
}

TEST_CASE("threads, corner: a clustered gas, cold by many orders of magnitude") {
  constexpr std::uint32_t disks = 4000;
  Simulation gas({.restitution = 0.6}, initial_state(0.4, disks, 1, 2));
  gas.run_to(collisions_at(300, disks));
  REQUIRE(gas.exponent() > 3);
  agrees({.restitution = 0.6}, gas.state(), 3);
}

// ---- collapse ---------------------------------------------------------------------------------

TEST_CASE("threads, corner: strong dissipation ends in the same collapse, or goes on") {
  for (const double e : {0.0, 0.1, 0.3}) {
    CAPTURE(e);
    const State start = initial_state(0.4, particles, 1);
    const auto end_of = [&](const Threads& threads) {
      Simulation gas({.restitution = e}, start, SearchBackend::simd, threads);
      std::string end = "goes on";
      try {
        gas.run_to(collisions_at(12, particles));
      } catch (const Collapse& collapse) {
        end = collapse.what();
      }
      return std::tuple(end, gas.collisions(), gas.time(), gas.velocities());
    };
    const auto one = end_of({});
    CHECK((std::get<0>(one) == "goes on") == (e > 0.2));
    for (const Threads& threads : {Threads{.count = 2}, Threads{.count = 1, .slabs = 3},
                                   Threads{.count = 1, .slabs = 4, .window = 0.002}}) {
      CAPTURE(threads.slabs);
      CHECK(end_of(threads) == one);
    }
  }
}
