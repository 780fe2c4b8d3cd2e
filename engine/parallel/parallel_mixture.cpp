// SPDX-License-Identifier: GPL-3.0-or-later

// The variants for mixtures on several threads. Compiled once for each SIMD target.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/parallel/parallel_mixture.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/collision/rough_collision.hpp"
#include "engine/collision/two_species.hpp"
#include "engine/parallel/parallel_variant-inl.hpp"
#include "engine/restitution/any_restitution_model.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

std::unique_ptr<EngineVariant> mixture_on_threads(const Model& model, const State& start,
                                                  const Threads& threads) {
  const TwoSpecies geometry(model, start);
  if (model.effects.contains("roughness"))
    return on_threads<TwoSpecies>(RoughCollision(model, geometry), start, threads);
  return on_threads<TwoSpecies>(SmoothCollision(AnyRestitutionModel(model), geometry), start,
                                threads);
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haff::engine {

HWY_EXPORT(mixture_on_threads);

std::unique_ptr<EngineVariant> parallel_mixture(const Model& model, const State& start,
                                                const Threads& threads) {
  return HWY_DYNAMIC_DISPATCH(mixture_on_threads)(model, start, threads);
}

}  // namespace haff::engine
#endif
