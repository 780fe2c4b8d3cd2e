// SPDX-License-Identifier: GPL-3.0-or-later

// The part of an engine variant that follows from its physics alone: no event loop and no search,
// so it is compiled once rather than once for each SIMD target.
#pragma once

#include <optional>
#include <utility>

#include "engine/loop/engine_variant.hpp"

namespace haff::engine {

template <class Physics>
class PhysicsVariant : public EngineVariant {
 public:
  PhysicsVariant(Physics physics, const State& start) : physics_(std::move(physics)) {
    physics_.recall(start);
  }
  void start(Gas& gas) override { engine::start(gas.particles, gas.clock, physics_.masses()); }
  void audit(Gas& gas, double allowed_overlap) override {
    engine::audit(gas.particles, gas.clock, allowed_overlap, physics_.masses(),
                  physics_.rotation().value_or(Rotation{}));
  }
  void synchronize(Gas& gas) override {
    physics_.before_synchronization(gas.particles, gas.clock.now);
    engine::synchronize(gas.particles, gas.clock, gas.box, physics_.masses(), gas.team);
  }
  void store(State& state) const override { physics_.store(state); }
  void scale(int exponent) override { physics_.scale(exponent); }
  std::optional<Rotation> rotation() const override { return physics_.rotation(); }
  std::optional<CollisionCounts> take_collision_counts() override {
    if constexpr (requires { physics_.take_counts(); })
      return physics_.take_counts();
    else
      return std::nullopt;
  }
  std::size_t memory() const override { return physics_.memory(); }

 protected:
  Physics physics_;
};

}  // namespace haff::engine
