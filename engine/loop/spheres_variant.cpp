// SPDX-License-Identifier: GPL-3.0-or-later

// The variant for smooth equal spheres with SIMD, the base case. Compiled once for each SIMD
// target; the best one that the processor has is chosen at run time.
#include "engine/loop/engine_variant.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/loop/spheres_variant.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/collision/smooth_collision.hpp"
#include "engine/loop/engine_variant-inl.hpp"
#include "engine/restitution/restitution_models.hpp"
#include "engine/search/simd_search-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

std::unique_ptr<EngineVariant> simd_spheres(const Model& model, const Gas& gas,
                                            const State& start) {
  return with_restitution_model(
      model,
      [&]<class RestitutionModel>(
          const RestitutionModel& restitution) -> std::unique_ptr<EngineVariant> {
        using Physics = SmoothCollision<RestitutionModel>;
        if (gas.particles.size() < worth_prefetching)
          return std::make_unique<VariantOf<SimdSearch<3>, Physics>>(Physics(restitution), start);
        return std::make_unique<VariantOf<SimdSearch<3>, Physics, true>>(Physics(restitution),
                                                                         start);
      });
}

const char* target_name() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haff::engine {

HWY_EXPORT(simd_spheres);
HWY_EXPORT(target_name);

std::unique_ptr<EngineVariant> spheres_variant(const Model& model, const Gas& gas,
                                               const State& start) {
  return HWY_DYNAMIC_DISPATCH(simd_spheres)(model, gas, start);
}

std::string simd_target() {
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

}  // namespace haff::engine
#endif
