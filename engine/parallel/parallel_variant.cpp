// SPDX-License-Identifier: GPL-3.0-or-later

// The variants that run on several threads. Compiled once for each SIMD target.
#include "engine/loop/engine_variant.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/parallel/parallel_variant.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/collision/rough_collision.hpp"
#include "engine/collision/two_species.hpp"
#include "engine/parallel/parallel_variant-inl.hpp"
#include "engine/restitution/any_restitution_model.hpp"
#include "engine/search/simd_search-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

template <class PairGeometry, class Physics>
std::unique_ptr<EngineVariant> on_threads(Physics physics, const State& start,
                                          const Threads& threads) {
  if (start.d == 2)
    return std::make_unique<ParallelVariantOf<SimdSearch<2, PairGeometry>, Physics, 2>>(
        std::move(physics), start, threads);
  return std::make_unique<ParallelVariantOf<SimdSearch<3, PairGeometry>, Physics, 3>>(
      std::move(physics), start, threads);
}

std::unique_ptr<EngineVariant> simd_on_threads(const Model& model, const State& start,
                                               const Threads& threads) {
  const bool rough = model.effects.contains("roughness");
  const bool mixed = model.effects.contains("mixture");
  if (rough && mixed)
    return on_threads<TwoSpecies>(RoughCollision(model, TwoSpecies(model, start)), start, threads);
  if (mixed)
    return on_threads<TwoSpecies>(
        SmoothCollision(AnyRestitutionModel(model), TwoSpecies(model, start)), start, threads);
  if (rough) return on_threads<HardSpheres>(RoughCollision(model), start, threads);
  if (model.law.name == ConstantRestitution::name)
    return on_threads<HardSpheres>(SmoothCollision(ConstantRestitution(model.restitution)), start,
                                   threads);
  return on_threads<HardSpheres>(SmoothCollision(AnyRestitutionModel(model)), start, threads);
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haff::engine {

HWY_EXPORT(simd_on_threads);

std::unique_ptr<EngineVariant> parallel_variant(const Model& model, const State& start,
                                                const Threads& threads) {
  return HWY_DYNAMIC_DISPATCH(simd_on_threads)(model, start, threads);
}

}  // namespace haff::engine
#endif
