// SPDX-License-Identifier: GPL-3.0-or-later

// The variants that count collisions (observed_collision.hpp), for any physics. Compiled once for
// each SIMD target.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/loop/observed_variant.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/collision/observed_collision.hpp"
#include "engine/collision/two_species.hpp"
#include "engine/loop/engine_variant-inl.hpp"
#include "engine/search/called_search-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

template <class PairGeometry>
std::unique_ptr<EngineVariant> with_simd(ObservedCollision<PairGeometry> physics,
                                         const State& start) {
  using Physics = ObservedCollision<PairGeometry>;
  using Search = CalledSearch<PairGeometry>;
  if (start.d == 2 || start.id.size() < worth_prefetching)
    return std::make_unique<VariantOf<Search, Physics>>(std::move(physics), start);
  return std::make_unique<VariantOf<Search, Physics, true>>(std::move(physics), start);
}

std::unique_ptr<EngineVariant> simd_observed(const Model& model, const State& start) {
  if (model.effects.contains("mixture"))
    return with_simd(ObservedCollision<TwoSpecies>(model, TwoSpecies(model, start)), start);
  return with_simd(ObservedCollision<>(model), start);
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haff::engine {

HWY_EXPORT(simd_observed);

std::unique_ptr<EngineVariant> observed_variant(const Model& model, const Gas& gas,
                                                const State& start, SearchBackend backend) {
  if (backend == SearchBackend::simd && gas.tells_images_apart())
    return HWY_DYNAMIC_DISPATCH(simd_observed)(model, start);
  if (model.effects.contains("mixture"))
    return HWY_NAMESPACE::plain<TwoSpecies>(
        ObservedCollision<TwoSpecies>(model, TwoSpecies(model, start)), start);
  return HWY_NAMESPACE::plain<HardSpheres>(ObservedCollision<>(model), start);
}

}  // namespace haff::engine
#endif
