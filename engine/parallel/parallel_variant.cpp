// SPDX-License-Identifier: GPL-3.0-or-later

// The variants that run on several threads, for particles of one kind. Compiled once for each SIMD
// target; those of mixtures are in parallel_mixture.cpp.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/parallel/parallel_variant.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/collision/rough_collision.hpp"
#include "engine/parallel/parallel_variant-inl.hpp"
#include "engine/restitution/any_restitution_model.hpp"
#include "engine/restitution/constant_restitution.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

std::unique_ptr<EngineVariant> equal_on_threads(const Model& model, const State& start,
                                                const Threads& threads) {
  if (model.effects.contains("roughness"))
    return on_threads<HardSpheres>(RoughCollision(model), start, threads);
  // The base case, for which the search is inlined, too.
  using BaseCase = SmoothCollision<ConstantRestitution>;
  if (model.law.name == ConstantRestitution::name && start.d == 3)
    return std::make_unique<ParallelVariantOf<BaseCase, CalledSearch<>, SimdSearch<3>>>(
        BaseCase(ConstantRestitution(model.restitution)), start, threads);
  return on_threads<HardSpheres>(SmoothCollision(AnyRestitutionModel(model)), start, threads);
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haff::engine {

HWY_EXPORT(equal_on_threads);

std::unique_ptr<EngineVariant> parallel_variant(const Model& model, const State& start,
                                                const Threads& threads) {
  if (model.effects.contains("mixture")) return parallel_mixture(model, start, threads);
  return HWY_DYNAMIC_DISPATCH(equal_on_threads)(model, start, threads);
}

}  // namespace haff::engine
#endif
