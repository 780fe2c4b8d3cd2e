// SPDX-License-Identifier: GPL-3.0-or-later

// The engine against the naive reference: every event and every bit.
#include "support/reference.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "engine/initial.hpp"
#include "engine/support/random.hpp"

using namespace haff;

namespace {

template <class RestitutionModel = engine::ConstantRestitution>
void agrees(std::uint32_t particles, double n, double restitution, std::uint64_t seed, double tau,
            engine::SearchBackend prediction, const engine::RestitutionLaw& law = {},
            const std::map<std::string, engine::Parameters>& effects = {}, int d = 3) {
  CAPTURE(d);
  CAPTURE(particles);
  CAPTURE(n);
  CAPTURE(restitution);
  CAPTURE(seed);
  const engine::Model model{
      .restitution = restitution, .law = law, .effects = effects, .seed = seed};
  const engine::State start = engine::initial_state(n, particles, seed, d);
  engine::Simulation gas(model, start, prediction);
  tests::Reference<RestitutionModel> reference(model, start);
  const std::int64_t last = engine::collisions_at(tau, particles);
  for (std::int64_t collisions = 1; collisions <= last; ++collisions) {
    gas.run_to(collisions);
    reference.step();
    CAPTURE(collisions);
    REQUIRE(gas.time() == reference.time());
    REQUIRE(gas.velocities() == reference.velocities());
    REQUIRE(gas.synchronized() == reference.synchronized());
    if (gas.synchronized()) REQUIRE(gas.state() == reference.state());
  }
}

}  // namespace

// Boxes of at least six diameters, for which the vectorized search is used.
TEST_CASE("SIMD engine equals the reference") {
  for (const double e : {1.0, 0.8, 0.5}) {
    agrees(70, 0.05, e, 7, 12, engine::SearchBackend::simd);
    agrees(88, 0.4, e, 7, 11, engine::SearchBackend::simd);
    agrees(200, 0.9, e, 7, 1, engine::SearchBackend::simd);
  }
}

TEST_CASE("scalar engine equals the reference") {
  agrees(70, 0.05, 0.8, 7, 12, engine::SearchBackend::scalar);
  agrees(88, 0.4, 0.8, 7, 11, engine::SearchBackend::scalar);
}

// Scenes are drawn at random, each one different but the same in every run of the test: sparse and
// dense, elastic and nearly plastic, boxes of a few diameters up to some cells.
TEST_CASE("random scenes equal the reference") {
  engine::Random random(20031, engine::Stream::velocities);
  const auto between = [&](double low, double high) {
    return low + (high - low) * random.uniform();
  };
  for (int scene = 0; scene < 30; ++scene) {
    const double n = std::exp(between(std::log(0.02), std::log(0.9)));
    const double side = between(2.1, 8);
    const auto particles = std::clamp(static_cast<std::uint32_t>(n * side * side * side), 2u, 90u);
    const double e = between(0, 1) < 0.2 ? 1 : between(0.4, 1);
    const auto seed = static_cast<std::uint64_t>(scene);
    const double least = 2.0 * 2.0 * 2.0;  // the smallest box [sigma^3]
    agrees(particles, std::min(n, particles / (1.01 * least)), e, seed, 10.5,
           scene % 4 == 0 ? engine::SearchBackend::scalar : engine::SearchBackend::simd);
  }
}

// Two particles that are mirror images cross faces of their cells at the same time, half a box
// apart. The random scenes above found this case, in which the contact with the farther image was
// missed.
TEST_CASE("mirrored particles in a box of four cells equal the reference") {
  agrees(2, 0.0302767, 1.0, 18, 60, engine::SearchBackend::simd);
}

TEST_CASE("boxes too small for cells equal the reference") {
  agrees(2, 0.2, 1.0, 1, 60, engine::SearchBackend::simd);
  agrees(3, 0.3, 0.9, 2, 60, engine::SearchBackend::simd);
  agrees(8, 0.5, 0.9, 3, 40, engine::SearchBackend::simd);
  agrees(32, 0.8, 0.7, 4, 20, engine::SearchBackend::simd);
}

TEST_CASE("restitution laws equal the reference") {
  const engine::RestitutionLaw threshold{"threshold", {{"speed", 0.3}}};
  const engine::RestitutionLaw tc{"tc", {{"t_c", 0.02}}};
  for (const double e : {0.8, 0.3}) {
    agrees<engine::ElasticThreshold>(70, 0.4, e, 7, 32, engine::SearchBackend::simd, threshold);
    agrees<engine::ContactDuration>(70, 0.4, e, 7, 32, engine::SearchBackend::simd, tc);
    agrees<engine::ContactDuration>(70, 0.4, e, 7, 12, engine::SearchBackend::scalar, tc);
    agrees<engine::ContactDuration>(8, 0.5, e, 3, 40, engine::SearchBackend::simd, tc);
  }
  const engine::RestitutionLaw viscoelastic{"viscoelastic", {{"A", 0.3}}};
  agrees<engine::Viscoelastic>(70, 0.4, 1, 7, 42, engine::SearchBackend::simd, viscoelastic);
  agrees<engine::Viscoelastic>(8, 0.5, 1, 3, 40, engine::SearchBackend::scalar, viscoelastic);
  const engine::RestitutionLaw plastic{"plastic", {{"speed", 0.3}}};
  agrees<engine::PlasticImpact>(70, 0.4, 1, 7, 42, engine::SearchBackend::simd, plastic);
}

TEST_CASE("actions equal the reference") {
  const auto acted = [](const std::map<std::string, engine::Parameters>& effects) {
    agrees(70, 0.4, 0.8, 7, 32, engine::SearchBackend::simd, {}, effects);
    agrees(70, 0.4, 0.8, 7, 12, engine::SearchBackend::scalar, {}, effects);
    agrees(8, 0.5, 0.9, 3, 40, engine::SearchBackend::simd, {}, effects);
  };
  acted({{"shuffle", {{"every", 1}}}});
  acted({{"shuffle", {{"every", 0.7}}}});
  acted({{"thermostat", {{"rate", 0.5}}}});
  acted({{"shuffle", {{"every", 3}}}, {"thermostat", {{"rate", 0.5}}}});
}

namespace {

template <class RestitutionModel = engine::ConstantRestitution>
void disks_agree(std::uint32_t particles, double n, double e, std::uint64_t seed, double tau,
                 engine::SearchBackend prediction, const engine::RestitutionLaw& law = {},
                 const std::map<std::string, engine::Parameters>& effects = {}) {
  agrees<RestitutionModel>(particles, n, e, seed, tau, prediction, law, effects, 2);
}

}  // namespace

TEST_CASE("disks equal the reference") {
  for (const double e : {1.0, 0.8, 0.5}) {
    disks_agree(30, 0.05, e, 7, 22, engine::SearchBackend::simd);
    disks_agree(60, 0.4, e, 7, 21, engine::SearchBackend::simd);
    disks_agree(80, 1.0, e, 7, 5, engine::SearchBackend::simd);
  }
  disks_agree(60, 0.4, 0.8, 7, 21, engine::SearchBackend::scalar);
}

// Like the random scenes of spheres; most of these boxes are smaller than six diameters.
TEST_CASE("random scenes of disks equal the reference") {
  engine::Random random(20032, engine::Stream::velocities);
  const auto between = [&](double low, double high) {
    return low + (high - low) * random.uniform();
  };
  for (int scene = 0; scene < 40; ++scene) {
    const double n = std::exp(between(std::log(0.02), std::log(0.85)));
    const double side = between(2.1, 12);
    const auto particles = std::clamp(static_cast<std::uint32_t>(n * side * side), 2u, 90u);
    const double e = between(0, 1) < 0.2 ? 1 : between(0.4, 1);
    const double least = 2.0 * 2.0;  // the smallest box [sigma^2]
    disks_agree(particles, std::min(n, particles / (1.01 * least)), e,
                static_cast<std::uint64_t>(scene), 10.5,
                scene % 4 == 0 ? engine::SearchBackend::scalar : engine::SearchBackend::simd);
  }
}

TEST_CASE("disks with restitution laws and actions equal the reference") {
  const engine::RestitutionLaw threshold{"threshold", {{"speed", 0.3}}};
  const engine::RestitutionLaw tc{"tc", {{"t_c", 0.02}}};
  for (const double e : {0.8, 0.3}) {
    disks_agree<engine::ElasticThreshold>(60, 0.4, e, 7, 22, engine::SearchBackend::simd,
                                          threshold);
    disks_agree<engine::ContactDuration>(60, 0.4, e, 7, 22, engine::SearchBackend::simd, tc);
    disks_agree<engine::ContactDuration>(6, 0.4, e, 3, 40, engine::SearchBackend::simd, tc);
  }
  disks_agree(60, 0.4, 0.8, 7, 22, engine::SearchBackend::simd, {},
              {{"shuffle", {{"every", 0.7}}}});
  disks_agree(60, 0.4, 0.8, 7, 22, engine::SearchBackend::simd, {},
              {{"thermostat", {{"rate", 0.5}}}});
}
