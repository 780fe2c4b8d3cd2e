// SPDX-License-Identifier: GPL-3.0-or-later

// The variants for binary mixtures. Compiled once for each SIMD target, for all restitution models
// together.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/loop/mixture_variant.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/collision/smooth_collision.hpp"
#include "engine/collision/two_species.hpp"
#include "engine/loop/engine_variant-inl.hpp"
#include "engine/restitution/any_restitution_model.hpp"
#include "engine/search/simd_search-inl.hpp"

namespace haff::engine {
using SmoothMixture = SmoothCollision<AnyRestitutionModel, TwoSpecies>;
}

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

std::unique_ptr<EngineVariant> simd_mixture(const Model& model, const State& start) {
  SmoothMixture physics(AnyRestitutionModel(model), TwoSpecies(model, start));
  if (start.d == 2)
    return std::make_unique<VariantOf<SimdSearch<2, TwoSpecies>, SmoothMixture>>(std::move(physics),
                                                                                 start);
  return std::make_unique<VariantOf<SimdSearch<3, TwoSpecies>, SmoothMixture>>(std::move(physics),
                                                                               start);
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haff::engine {

HWY_EXPORT(simd_mixture);

std::unique_ptr<EngineVariant> mixture_variant(const Model& model, const Gas& gas,
                                               const State& start, SearchBackend backend) {
  if (backend == SearchBackend::simd && gas.tells_images_apart())
    return HWY_DYNAMIC_DISPATCH(simd_mixture)(model, start);
  return HWY_NAMESPACE::plain<TwoSpecies>(
      SmoothMixture(AnyRestitutionModel(model), TwoSpecies(model, start)), start);
}

}  // namespace haff::engine
#endif
