// SPDX-License-Identifier: GPL-3.0-or-later

// An engine variant, made from a search and a physics. Compiled once for each SIMD target, like the
// loop that it runs.
#if defined(HAFF_ENGINE_VARIANT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAFF_ENGINE_VARIANT_INL
#undef HAFF_ENGINE_VARIANT_INL
#else
#define HAFF_ENGINE_VARIANT_INL
#endif

#include "engine/loop/engine_variant.hpp"
#include "engine/loop/event_loop-inl.hpp"
#include "engine/restitution/restitution_models.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

template <class Search, class Physics, bool prefetching = false>
class VariantOf : public EngineVariant {
 public:
  VariantOf(Physics physics, const State& start) : physics_(std::move(physics)) {
    physics_.recall(start);
  }
  void run(Gas& gas, std::int64_t collisions, double end) override {
    EventLoop<Search, Physics, prefetching>(gas, physics_).run(collisions, end);
  }
  void predict_all(Gas& gas) override { EventLoop<Search, Physics>(gas, physics_).predict_all(); }
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

// Without SIMD. The size of the box decides which images are candidates.
template <class PairGeometry, int d, class Physics>
std::unique_ptr<EngineVariant> plain(Physics physics, const Gas& gas, const State& start) {
  if (!Bricks::fits(gas.box))
    return std::make_unique<
        VariantOf<PlainSearch<PairGeometry, AllParticlesAllImages, d>, Physics>>(std::move(physics),
                                                                                 start);
  if (!gas.bricks.tell_images_apart())
    return std::make_unique<VariantOf<PlainSearch<PairGeometry, NearbyAllImages, d>, Physics>>(
        std::move(physics), start);
  return std::make_unique<VariantOf<PlainSearch<PairGeometry, NearbyNearestImage, d>, Physics>>(
      std::move(physics), start);
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
