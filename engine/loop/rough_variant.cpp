// SPDX-License-Identifier: GPL-3.0-or-later

// The variants for rough spheres and disks, and mixtures of them. They touch when smooth particles
// would, so the SIMD search serves them, too: compiled once for each target.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/loop/rough_variant.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/collision/rough_collision.hpp"
#include "engine/collision/two_species.hpp"
#include "engine/loop/engine_variant-inl.hpp"
#include "engine/search/simd_search-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

std::unique_ptr<EngineVariant> simd_rough_mixture(const Model& model, const State& start) {
  using Physics = RoughCollision<TwoSpecies>;
  Physics physics(model, TwoSpecies(model, start));
  if (start.d == 2)
    return std::make_unique<VariantOf<SimdSearch<2, TwoSpecies>, Physics>>(std::move(physics),
                                                                           start);
  return std::make_unique<VariantOf<SimdSearch<3, TwoSpecies>, Physics>>(std::move(physics), start);
}

std::unique_ptr<EngineVariant> simd_rough_particles(const Model& model, const State& start) {
  if (model.effects.contains("mixture")) return simd_rough_mixture(model, start);
  RoughCollision physics(model);
  if (start.d == 2)
    return std::make_unique<VariantOf<SimdSearch<2>, RoughCollision<>>>(std::move(physics), start);
  if (start.id.size() < worth_prefetching)
    return std::make_unique<VariantOf<SimdSearch<3>, RoughCollision<>>>(std::move(physics), start);
  return std::make_unique<VariantOf<SimdSearch<3>, RoughCollision<>, true>>(std::move(physics),
                                                                            start);
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haff::engine {

HWY_EXPORT(simd_rough_particles);

std::unique_ptr<EngineVariant> rough_variant(const Model& model, const Gas& gas, const State& start,
                                             SearchBackend backend) {
  if (backend == SearchBackend::simd && gas.tells_images_apart())
    return HWY_DYNAMIC_DISPATCH(simd_rough_particles)(model, start);
  if (model.effects.contains("mixture"))
    return HWY_NAMESPACE::plain<TwoSpecies>(RoughCollision(model, TwoSpecies(model, start)), start);
  return HWY_NAMESPACE::plain<HardSpheres>(RoughCollision(model), start);
}

}  // namespace haff::engine
#endif
