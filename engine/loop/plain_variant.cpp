// SPDX-License-Identifier: GPL-3.0-or-later

// The variants without SIMD: compiled once rather than once for each target, and for all
// restitution models together, since speed does not matter here.
#include <hwy/highway.h>

#include "engine/collision/smooth_collision.hpp"
#include "engine/loop/engine_variant-inl.hpp"
#include "engine/restitution/any_restitution_model.hpp"

namespace haff::engine {

std::unique_ptr<EngineVariant> plain_variant(const Model& model, const Gas& gas,
                                             const State& start) {
  SmoothCollision physics{AnyRestitutionModel(model)};
  return gas.box.d == 2 ? HWY_NAMESPACE::plain<HardSpheres, 2>(std::move(physics), gas, start)
                        : HWY_NAMESPACE::plain<HardSpheres, 3>(std::move(physics), gas, start);
}

}  // namespace haff::engine
