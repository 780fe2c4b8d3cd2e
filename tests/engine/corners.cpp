// SPDX-License-Identifier: GPL-3.0-or-later

// Special cases in which event-driven engines fail. Long versions: tests/validate/corners.cpp.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/initial.hpp"
#include "engine/particles/synchronize.hpp"
#include "engine/soundness.hpp"
#include "support/gas.hpp"
#include "support/reference.hpp"

using namespace haff;
using namespace haff::tests;
using engine::Simulation;
using engine::State;
using engine::Vector;

namespace {

constexpr engine::SearchBackend plain = engine::SearchBackend::scalar;

State without_momentum(State state) {
  Vector mean{};
  for (const Vector& v : state.velocity)
    for (std::size_t k = 0; k < 3; ++k) mean[k] += v[k] / static_cast<double>(state.id.size());
  for (Vector& v : state.velocity)
    for (std::size_t k = 0; k < 3; ++k) v[k] -= mean[k];
  return state;
}

// The same events and bits as in the naive engine, with no event lost or out of order.
void agrees(const engine::Model& model, const State& any, double tau) {
  const State start = without_momentum(any);
  Simulation gas(model, start);
  Simulation scalar(model, start, plain);
  Reference<> reference(model, start);
  const std::int64_t last = engine::collisions_at(tau, start.particles());
  double time = 0;
  for (std::int64_t collisions = 1; collisions <= last; ++collisions) {
    gas.run_to(collisions);
    scalar.run_to(collisions);
    reference.step();
    CAPTURE(collisions);
    REQUIRE(gas.time() >= time);
    time = gas.time();
    REQUIRE(time == reference.time());
    REQUIRE(gas.velocities() == reference.velocities());
    REQUIRE(scalar.velocities() == reference.velocities());
  }
  CHECK_FALSE(engine::violation(gas.invariants(), engine::smallest_allowed_overlap));
}

// True velocities by id, before the first synchronization.
std::vector<Vector> by_id(const Simulation& gas, const State& start) {
  std::vector<Vector> sorted(start.id.size());
  const auto velocities = gas.velocities();
  for (std::size_t k = 0; k < sorted.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c)
      sorted[start.id[k]][c] = std::ldexp(velocities[k][c], -gas.exponent());
  return sorted;
}

double temperature_ratio(const Simulation& gas) {
  return energy(gas) / gas.particles();
}

}  // namespace

// ---- endless cooling --------------------------------------------------------------------------

TEST_CASE("corner: cooling to T/T0 = 1e-60 in a box too small for clusters") {
  constexpr std::uint32_t particles = 256;
  constexpr double e = 0.8;
  Simulation gas({.restitution = e}, engine::initial_state(0.4, particles, 1));
  const double gamma0 = (1 - e * e) / 6;
  double tau = 0;
  double time = 0;
  while (temperature_ratio(gas) > 1e-60) {
    tau += engine::synchronization_period;
    gas.run_to(engine::collisions_at(tau, particles));
    REQUIRE(std::isfinite(gas.time()));
    // In scaled units event times lie between 0 and the length of a period. The mean free time is a
    // tenth of the period on average, and grows by e^(gamma_0 10) within it; event times must
    // resolve it throughout.
    const double period = std::ldexp(gas.time() - time, -gas.exponent());
    const double mean_free_time = 0.1 * period * std::exp(-10 * gamma0);
    REQUIRE(period * std::numeric_limits<double>::epsilon() < 1e-12 * mean_free_time);
    REQUIRE(gas.time() > time);
    time = gas.time();
  }
  // The rate of decay is gamma_0, up to a2 (0.5 %) and the noise of 256 particles; correlations in
  // a box below 2 pi xi_perp lower it by some per cent.
  const double rate = -std::log(temperature_ratio(gas)) / tau;
  CHECK(rate / (2 * gamma0) == doctest::Approx(1).epsilon(0.05));
  // Without correction, the centre of mass would carry 1e-32 of the initial energy.
  CHECK(relative_momentum(gas) < 1e-12);
  CHECK(gas.invariants().momentum_removed > 0);
  CHECK(gas.invariants().momentum_removed < engine::allowed_momentum);
  CHECK(gas.exponent() >= 99);  // 2^-100 = 1e-30
}

// Clustering gases of N = 6 10^5 were once refused: the momentum found is the rounding of the sum.
TEST_CASE("corner: rounding in the momentum of a large, streaming gas is accepted") {
  constexpr std::uint32_t particles = 1'000'000;
  std::vector<engine::Particle> gas(particles);
  for (std::uint32_t id = 0; id < particles; ++id) {
    const double phase = 2 * std::numbers::pi * id / particles;  // along the curve through space
    gas[id].velocity = {std::sin(phase), std::cos(phase), std::sin(2 * phase + 1)};
  }
  engine::remove_momentum<>(gas);
  // Another synchronization sums in another order.
  std::rotate(gas.begin(), gas.begin() + particles / 3, gas.end());
  const double rounding = engine::remove_momentum<>(gas);
  CHECK(rounding > 1e-13);
  CHECK_FALSE(engine::violation({.momentum_removed = rounding}, 1));
  // One particle gains momentum, as if its partner had not recoiled.
  gas.front().velocity[0] += 0.01;
  CHECK(engine::violation({.momentum_removed = engine::remove_momentum<>(gas)}, 1));
}

TEST_CASE("corner: scaling velocities by a power of two changes no other bit") {
  const State start = engine::initial_state(0.4, 108, 3);
  State cold = start;
  for (Vector& v : cold.velocity)
    for (double& x : v) x *= 0x1p-100;
  Simulation one({.restitution = 0.7}, start);
  Simulation other({.restitution = 0.7}, cold);
  for (const double tau : {3.0, 10.0, 57.0, 120.0}) {
    one.run_to(engine::collisions_at(tau, 108));
    other.run_to(engine::collisions_at(tau, 108));
    CHECK(one.positions() == other.positions());
    const auto fast = one.velocities();
    const auto slow = other.velocities();
    for (std::size_t k = 0; k < fast.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c)
        CHECK(fast[k][c] == std::ldexp(slow[k][c], one.exponent() + 100 - other.exponent()));
    CHECK(one.time() == std::ldexp(other.time(), -100));
  }
}

// ---- endless elastic runs ----------------------------------------------------------------------

TEST_CASE("corner: a million elastic collisions") {
  // Rounding: 1e6 random steps of 1e-16 of a particle's energy. tests/validate has 1e8 collisions.
  constexpr std::uint32_t particles = 500;
  Simulation gas({.restitution = 1}, engine::initial_state(0.4, particles, 1));
  gas.run_to(1'000'000);
  CHECK(std::abs(energy(gas) / particles - 1) < 1e-12);
  CHECK(relative_momentum(gas) < 1e-12);
  CHECK(engine::largest_overlap(gas.invariants()) < 1e-13);
  CHECK(gas.invariants().past_events == 0);
  CHECK(gas.invariants().unresolved_collisions == 0);
}

// ---- dense and dilute -------------------------------------------------------------------------

TEST_CASE("corner: a dense crystal keeps its pressure and does not overlap") {
  // R. J. Speedy, J. Phys.: Condens. Matter 10, 4387 (1998), at phi = 0.70; 500 particles and 5e4
  // collisions give the pressure to 1 % (tests/validate has more of both, and other densities).
  Simulation gas({.restitution = 1}, engine::initial_state(0.70 * 6 / std::numbers::pi, 500, 1));
  gas.run_to(engine::collisions_at(100, 500));
  const double z = 0.70 / (std::numbers::pi * std::sqrt(2.0) / 6);
  const double pressure_by_speedy = 3 / (1 - z) - 0.5921 * (z - 0.7072) / (z - 0.601);
  CHECK(compressibility(gas, 200) == doctest::Approx(pressure_by_speedy).epsilon(0.01));
  CHECK(engine::largest_overlap(gas.invariants()) < 1e-13);
}

TEST_CASE("corner: cells of a very dilute gas adapt") {
  // The number of cells is proportional to that of particles, not to the volume (2e7 sigma^3).
  Simulation gas({.restitution = 1}, engine::initial_state(1e-4, 2000, 1));
  gas.run_to(engine::collisions_at(1, 2000));
  CHECK(static_cast<double>(gas.memory()) / 2000 < 1000);
}

TEST_CASE("corner: a box that is too small is refused with the smallest side") {
  State state = engine::initial_state(0.2, 2, 1);
  state.box = 1.9;
  CHECK_THROWS_WITH_AS(Simulation({.restitution = 1}, state), doctest::Contains("at least 2 sigma"),
                       std::invalid_argument);
}

// ---- borderline contacts ------------------------------------------------------------------------

TEST_CASE("corner: grazing contacts") {
  // Two particles pass at 1 +- a few roundings, among others: hit or miss, time goes on.
  for (int k = -4; k <= 4; ++k) {
    CAPTURE(k);
    const double offset = 1 + k * 0x1p-52;
    agrees({.restitution = 0.9},
           state_of(8, {{1, 2, 2}, {4, 2 + offset, 2}, {2, 6, 5}, {6, 6.3, 5.2}},
                    {{1, 0, 0}, {-1, 0, 0}, {0.5, 0, 0}, {-0.5, 0, 0}}),
           15);
  }
}

TEST_CASE("corner: pairs at contact within rounding") {
  for (int k = -4; k <= 4; ++k)
    for (const double speed : {1.0, 1e-8, 0.0, -1e-8, -1.0}) {
      CAPTURE(k);
      CAPTURE(speed);
      agrees({.restitution = 0.8},
             state_of(8, {{1, 2, 2}, {2 + k * 0x1p-52, 2, 2}, {5, 2.2, 2.1}, {2, 6, 5}},
                      {{speed, 0, 0}, {0, 0, 0}, {-0.7, 0.1, 0}, {0.7, -speed, 0.3}}),
             15);
    }
}

TEST_CASE("corner: two particles at rest relative to each other, and particles at rest") {
  // 0 and 1 touch and fly side by side; 2 and 3 do not move until 0 hits them.
  agrees({.restitution = 0.9},
         state_of(8, {{1, 2, 2}, {1, 3, 2}, {4, 2.1, 2}, {6, 3, 2}},
                  {{1, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 0, 0}}),
         12);
}

TEST_CASE("corner: speeds that differ by 1e8") {
  State state = engine::initial_state(0.3, 32, 2);
  for (std::size_t k = 2; k < state.velocity.size(); ++k)
    for (double& v : state.velocity[k]) v *= 1e-8;
  for (std::size_t k = 0; k < 3; ++k) state.velocity[1][k] = -state.velocity[0][k];
  agrees({.restitution = 0.9}, state, 20);
}

// ---- at the same time -------------------------------------------------------------------------

TEST_CASE("corner: a lattice in which all particles collide at once") {
  // A simple cubic lattice whose neighbours along x approach in pairs: all pairs exchange
  // velocities at exactly the same time, and then collide with the neighbours on the other side,
  // again all at once.
  constexpr int side = 4;
  std::vector<Vector> positions, velocities;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) {
        positions.push_back({2.0 * x, 2.0 * y, 2.0 * z});
        velocities.push_back({x % 2 == 0 ? 1.0 : -1.0, 0, 0});
      }
  const State start = state_of(2.0 * side, positions, velocities);
  Simulation gas({.restitution = 1}, start);
  constexpr std::int64_t pairs = side * side * side / 2;
  for (std::int64_t round = 1; round <= 4; ++round) {
    gas.run_to(round * pairs);
    CHECK(gas.time() == static_cast<double>(round) - 0.5);
    const auto now = gas.velocities();
    for (std::size_t k = 0; k < now.size(); ++k) {
      const double expected = round % 2 == 0 ? velocities[k][0] : -velocities[k][0];
      CHECK(now[k] == Vector{expected, 0, 0});
    }
  }
  agrees({.restitution = 1}, start, 8);
  agrees({.restitution = 0.5}, start, 8);
}

TEST_CASE("corner: three-body contacts are conserved and ordered by id") {
  // 0 and 2 hit 1 at the same time; the contact of 0 and 1 has the smaller ids.
  const State start =
      state_of(12, {{2, 6, 6}, {6, 6, 6}, {10, 6, 6}}, {{1, 0, 0}, {0, 0, 0}, {-1, 0, 0}});
  Simulation gas({.restitution = 1}, start);
  gas.run_to(1);
  CHECK(by_id(gas, start) == std::vector<Vector>{{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}});
  gas.run_to(3);
  CHECK(gas.time() == 3);
  CHECK(by_id(gas, start) == std::vector<Vector>{{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}});
}

TEST_CASE("corner: of two partners met at the same time, the one with the smaller id comes first") {
  // At the time 3, particle 0 hits particle 3 and stops. Its search then finds 1 and 2, both of
  // which will hit it at the time 5, and whose own searches were made before.
  const State start = state_of(16, {{8, 4, 8}, {2, 7, 8}, {14, 7, 8}, {8, 8, 8}},
                               {{0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 0}});
  for (const auto search : {engine::SearchBackend::simd, plain}) {
    Simulation gas({.restitution = 1}, start, search);
    gas.run_to(1);
    CHECK(gas.time() == 3);
    gas.run_to(2);
    CHECK(gas.time() == 5);
    CHECK(by_id(gas, start) == std::vector<Vector>{{1, 0, 0}, {0, 0, 0}, {-1, 0, 0}, {0, 1, 0}});
  }
}

TEST_CASE("corner: Newton's cradle") {
  const State start =
      state_of(16, {{1, 8, 8}, {4, 8, 8}, {5, 8, 8}, {6, 8, 8}, {7, 8, 8}, {8, 8, 8}},
               {{1, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  Simulation gas({.restitution = 1}, start);
  gas.run_to(5);
  CHECK(gas.time() == 2);  // all five collisions are at the time of the first
  auto moving = by_id(gas, start);
  CHECK(moving.back() == Vector{1, 0, 0});
  moving.pop_back();
  for (const Vector& v : moving) CHECK(v == Vector{0, 0, 0});
}

// ---- faces ------------------------------------------------------------------------------------

TEST_CASE("corner: particles on the faces of cells and of the box, which cross several at once") {
  // A box of 6 has cells of 1.5: all 64 particles start on corners of cells.
  const State from = engine::initial_state(0.3, 64, 5);
  for (const double component : {1.0, -1.0}) {
    std::vector<Vector> positions;
    for (int k = 0; k < 64; ++k)
      positions.push_back({1.5 * (k % 4), 1.5 * (k / 4 % 4), 1.5 * (k / 16)});
    std::vector<Vector> velocities = from.velocity;
    for (std::size_t k = 0; k < 64; k += 2) velocities[k] = {component, component, component};
    agrees({.restitution = 0.9}, state_of(6, positions, velocities), 25);
  }
}

// ---- input ------------------------------------------------------------------------------------

TEST_CASE("corner: an overlapping state is refused with pair and depth") {
  State state = engine::initial_state(0.4, 108, 1);
  state.position[7] = state.position[3];
  state.position[7][0] += 0.75;
  CHECK_THROWS_WITH_AS(Simulation({.restitution = 1}, state), doctest::Contains("overlap by 0.25"),
                       std::invalid_argument);
}

TEST_CASE("corner: a state with a value that is not a number is refused") {
  State state = engine::initial_state(0.4, 108, 1);
  state.velocity[5][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS(Simulation({.restitution = 1}, state), doctest::Contains("not finite"),
                       std::invalid_argument);
}

// ---- collapse ---------------------------------------------------------------------------------

// A fourth particle is a hundredth of a diameter away from these three, and is not named.
TEST_CASE("corner: three particles in a line collapse below e = 7 - 4 sqrt(3), and are named") {
  const State start = state_of(12, {{2, 6, 6}, {5.5, 6, 6}, {10, 6, 6}, {5.5, 7.01, 6}},
                               {{1, 0, 0}, {0.1, 0, 0}, {-1.1, 0, 0}, {0, 0, 0}});
  for (const double e : {0.0, 0.01, 0.05, 0.07}) {
    CAPTURE(e);
    Simulation gas({.restitution = e}, start);
    try {
      gas.run_to(1000);
      FAIL("no collapse");
    } catch (const engine::Collapse& collapse) {
      CHECK(collapse.particles == std::vector<std::uint32_t>{0, 1, 2});
      CHECK(collapse.place[1] == 6);
      CHECK(collapse.collisions < 200);
      CHECK(gas.collisions() == collapse.collisions);
      CHECK(std::string(collapse.what()).find("0, 1 and 2") != std::string::npos);
    }
  }
}

TEST_CASE("corner: three particles in a line go on with a threshold or a duration of contact") {
  const State start = state_of(12, {{2, 6, 6}, {5.5, 6.1, 6}, {10, 6, 6.1}},
                               {{1, 0, 0}, {0.1, 0, 0}, {-1.1, 0, 0}});
  for (const engine::RestitutionLaw& law : {engine::RestitutionLaw{"threshold", {{"speed", 1e-3}}},
                                            engine::RestitutionLaw{"tc", {{"t_c", 1e-2}}}}) {
    CAPTURE(law.name);
    Simulation gas({.restitution = 0.05, .law = law}, start);
    double before = energy(gas);
    for (std::int64_t collisions = 1; collisions <= 3000; ++collisions) {
      gas.run_to(collisions);
      const double now = energy(gas);
      REQUIRE(now <= before * (1 + 1e-14));
      before = now;
    }
    CHECK(gas.time() > 10);
  }
}

TEST_CASE("corner: at e = 0 time goes on") {
  for (const std::uint32_t particles : {2u, 3u, 8u, 64u}) {
    CAPTURE(particles);
    Simulation gas({.restitution = 0}, engine::initial_state(0.2, particles, 1));
    double before = 0;
    try {
      for (double tau = 10; tau <= 60; tau += 10) {
        gas.run_to(engine::collisions_at(tau, particles));
        REQUIRE(gas.time() > before * (1 + 1e-6));
        before = gas.time();
      }
    } catch (const engine::Collapse&) {
      // A collapse may end the run, but must never look like time that goes on.
    }
  }
}

TEST_CASE("corner: strong dissipation ends or goes on, and never hangs") {
  for (const double e : {0.1, 0.3, 0.5}) {
    CAPTURE(e);
    const State start = engine::initial_state(0.4, 1000, 1);
    bool collapsed = false;
    Simulation gas({.restitution = e}, start);
    try {
      gas.run_to(engine::collisions_at(60, 1000));
    } catch (const engine::Collapse& collapse) {
      collapsed = true;
      CHECK(collapse.particles.size() >= 2);
    }
    CHECK(collapsed ==
          (e == 0.1));  // four particles in a line collapse below 0.17, within a short time
    Simulation softened({.restitution = e, .law = {"tc", {{"t_c", 1e-3}}}}, start);
    double before = energy(softened);
    for (double tau = 1; tau <= 60; ++tau) {
      softened.run_to(engine::collisions_at(tau, 1000));
      REQUIRE(energy(softened) <= before * (1 + 1e-14));
      before = energy(softened);
    }
  }
}

// ---- clusters ---------------------------------------------------------------------------------

TEST_CASE("corner: more particles near one place than a brick has slots") {
  // In a crystal at close packing, cells of little more than a diameter hold up to 3 particles.
  Simulation gas({.restitution = 1}, engine::initial_state(1.40, 500, 1));
  gas.run_to(engine::collisions_at(20, 500));
  CHECK_FALSE(engine::violation(gas.invariants(), engine::smallest_allowed_overlap));
  CHECK_FALSE(engine::unsoundness(gas.state()));
}

// ---- reversal ---------------------------------------------------------------------------------

TEST_CASE("corner: an elastic gas whose velocities are reversed returns to its start") {
  for (const std::uint32_t particles : {10u, 30u, 100u}) {
    CAPTURE(particles);
    const State start = engine::initial_state(0.3, particles, 4);
    const std::int64_t collisions = engine::collisions_at(10, particles);
    const auto end_of = [&](const State& from) {
      Simulation gas({.restitution = 1}, from);
      gas.run_to(collisions);
      return gas.state();
    };
    const State forth = end_of(start);

    // The growth of the distance between neighbouring trajectories, from 1e-9.
    State displaced = start;
    displaced.position[0][0] += 1e-9;
    const State other = end_of(displaced);
    double growth = 1;
    for (std::size_t k = 0; k < particles; ++k)
      for (std::size_t l = 0; l < particles; ++l)
        if (forth.id[k] == other.id[l])
          growth =
              std::max(growth, distance(forth.position[k], other.position[l], start.box) / 1e-9);

    State reversed = forth;
    for (Vector& v : reversed.velocity)
      for (double& x : v) x = -x;
    reversed.collisions = 0;
    reversed.time = 0;
    Simulation back({.restitution = 1}, reversed);
    back.run_to(collisions - 1);  // before a synchronization sorts the particles
    const double rest = forth.time - back.time();
    const auto positions = back.positions();
    const auto velocities = back.velocities();
    // The first collision of the run is the last one on the way back: its particles are left out.
    std::vector<double> errors;
    for (std::size_t k = 0; k < particles; ++k) {
      Vector at = positions[k];
      for (std::size_t c = 0; c < 3; ++c) at[c] += velocities[k][c] * rest;
      for (std::size_t l = 0; l < particles; ++l)
        if (forth.id[k] == start.id[l])
          errors.push_back(distance(at, start.position[l], start.box));
    }
    std::sort(errors.begin(), errors.end());
    const double error = errors[particles - 3];
    // Rounding enters in steps of 1e-16 and grows no faster than a displacement. Growth was
    // measured in one direction only, hence the factor of a hundred.
    MESSAGE("growth " << growth << ", error " << error);
    CHECK(error < 1e-14 * growth * 100);
  }
}
