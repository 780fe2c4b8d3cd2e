// SPDX-License-Identifier: GPL-3.0-or-later

// The variant for disks with SIMD. Compiled once for each SIMD target, like spheres_variant.cpp.
#include "engine/loop/engine_variant.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/loop/disks_variant.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/collision/smooth_collision.hpp"
#include "engine/loop/engine_variant-inl.hpp"
#include "engine/restitution/restitution_models.hpp"
#include "engine/search/simd_search-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

std::unique_ptr<EngineVariant> simd_disks(const Model& model, const State& start) {
  return with_restitution_model(
      model,
      [&]<class RestitutionModel>(
          const RestitutionModel& restitution) -> std::unique_ptr<EngineVariant> {
        return std::make_unique<VariantOf<SimdSearch<2>, SmoothCollision<RestitutionModel>>>(
            SmoothCollision(restitution), start);
      });
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haff::engine {

HWY_EXPORT(simd_disks);

std::unique_ptr<EngineVariant> disks_variant(const Model& model, const State& start) {
  return HWY_DYNAMIC_DISPATCH(simd_disks)(model, start);
}

}  // namespace haff::engine
#endif
