// The engine against the naive reference: every event, every bit.
#include "support/reference.hpp"

#include <doctest/doctest.h>

#include "engine/initial.hpp"

using namespace haff;

namespace {

void agrees(std::uint32_t particles, double n, double restitution, std::uint64_t seed, double tau,
            engine::Prediction prediction) {
  CAPTURE(particles);
  CAPTURE(n);
  CAPTURE(restitution);
  CAPTURE(seed);
  const engine::Model model{.restitution = restitution};
  const engine::State start = engine::initial_state(n, particles, seed);
  engine::Simulation gas(model, start, prediction);
  tests::Reference reference(model, start);
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

TEST_CASE("SIMD engine equals the reference") {
  for (const double n : {0.05, 0.4, 0.9})
    for (const double e : {1.0, 0.8, 0.5}) agrees(70, n, e, 7, 12, engine::Prediction::simd);
}

TEST_CASE("scalar engine equals the reference") {
  for (const double n : {0.05, 0.4, 0.9}) agrees(70, n, 0.8, 7, 12, engine::Prediction::scalar);
}

TEST_CASE("boxes too small for cells equal the reference") {
  agrees(2, 0.2, 1.0, 1, 60, engine::Prediction::simd);
  agrees(3, 0.3, 0.9, 2, 60, engine::Prediction::simd);
  agrees(8, 0.5, 0.9, 3, 40, engine::Prediction::simd);
  agrees(32, 0.8, 0.7, 4, 20, engine::Prediction::simd);
}
