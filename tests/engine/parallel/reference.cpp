// SPDX-License-Identifier: GPL-3.0-or-later

// A gas that is divided into two, three and four slabs against the naive reference, bit by bit, in
// the smallest boxes that have room for them, with windows of a few collisions and random stops.
// The gases are of disks, since the reference would take a minute for the spheres of two slabs;
// spheres are compared with one thread (parallel_loop.cpp), which is compared with the reference.
#include "support/reference.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <utility>

#include "engine/collision/rough_collision.hpp"
#include "engine/collision/two_species.hpp"
#include "engine/initial.hpp"
#include "engine/restitution/any_restitution_model.hpp"
#include "engine/support/random.hpp"

using namespace haff;
using namespace haff::engine;

namespace {

// One thread processes all slabs: the result does not depend on the scheduling of threads, and
// threads that wait for each other after every few collisions would take a minute.
template <class Physics>
void agrees(Physics physics, const Model& model, const State& start, unsigned slabs, double tau) {
  CAPTURE(start.d);
  CAPTURE(start.particles());
  CAPTURE(slabs);
  Random random(start.particles(), Stream::velocities);
  // Up to three collisions: in such thin slabs, longer windows nearly always have to be repaired.
  const double window = (0.3 + 2.7 * random.uniform()) / start.particles();
  Simulation gas(model, start, SearchBackend::simd, {.count = 1, .slabs = slabs, .window = window});
  tests::ReferenceOf<Physics> reference(std::move(physics), model, start);
  const std::int64_t last = collisions_at(tau, start.particles());
  std::int64_t stop = 0;
  for (std::int64_t collisions = 0; collisions < last;) {
    if (collisions == stop)
      stop = std::min(last, stop + 1 + static_cast<std::int64_t>(600 * random.uniform()));
    // A synchronization on the way is compared, too.
    const std::int64_t next = std::min(stop, next_synchronization(collisions, start.particles()));
    gas.run_to(next);
    for (; collisions < next; ++collisions) reference.step();
    CAPTURE(collisions);
    REQUIRE(gas.time() == reference.time());
    REQUIRE(gas.velocities() == reference.velocities());
    REQUIRE(gas.synchronized() == reference.synchronized());
    if (gas.synchronized()) REQUIRE(gas.state() == reference.state());
  }
  REQUIRE(gas.windows());
  CHECK(gas.windows()->in_slabs > 0);
  CHECK(gas.windows()->in_zones > 0);
}

// A slab takes eight layers of cells, and a cell 0.4 particles.
std::uint32_t fewest_disks(unsigned slabs) {
  return 30 * slabs * slabs;
}

void disks_agree(const Model& model, unsigned slabs, double tau) {
  const State start = initial_state(0.4, fewest_disks(slabs), slabs, 2);
  agrees(SmoothCollision(AnyRestitutionModel(model)), model, start, slabs, tau);
}

const Parameters mixed{{"fraction", 0.5}, {"diameter_ratio", 0.8}, {"mass_ratio", 0.5}};
const Parameters rough{{"beta", 0.5}, {"q", 0.4}};

}  // namespace

TEST_CASE("threads: disks on two, three and four slabs equal the reference") {
  for (const double e : {1.0, 0.7}) {
    disks_agree({.restitution = e}, 2, 21);
    disks_agree({.restitution = e}, 3, 5);
    disks_agree({.restitution = e}, 4, 2);
  }
}

TEST_CASE("threads: restitution laws and a shuffle on slabs equal the reference") {
  for (const RestitutionLaw& law :
       {RestitutionLaw{"threshold", {{"speed", 0.3}}}, RestitutionLaw{"tc", {{"t_c", 0.02}}},
        RestitutionLaw{"viscoelastic", {{"A", 0.3}}},
        RestitutionLaw{"plastic", {{"speed", 0.3}}}}) {
    CAPTURE(law.name);
    disks_agree({.restitution = 0.6, .law = law}, 2, 12);
  }
  disks_agree({.restitution = 0.8, .effects = {{"shuffle", {{"every", 3}}}}, .seed = 3}, 3, 7);
}

TEST_CASE("threads: rough disks and mixtures on slabs equal the reference") {
  const Model rough_model{.restitution = 0.8, .effects = {{"roughness", rough}}};
  const Model mixed_model{.restitution = 0.8, .effects = {{"mixture", mixed}}};
  const Model both{.restitution = 0.8, .effects = {{"roughness", rough}, {"mixture", mixed}}};
  for (const unsigned slabs : {2u, 3u}) {
    const State start = initial_state(0.4, fewest_disks(slabs), 5, 2);
    const State mixture = initial_state(0.4, fewest_disks(slabs), 5, 2, mixed_model.effects);
    const double tau = slabs == 2 ? 11 : 3;
    agrees(RoughCollision<>(rough_model), rough_model, start, slabs, tau);
    agrees(SmoothCollision(AnyRestitutionModel(mixed_model), TwoSpecies(mixed_model, mixture)),
           mixed_model, mixture, slabs, tau);
    agrees(RoughCollision(both, TwoSpecies(both, mixture)), both, mixture, slabs, tau);
  }
}
