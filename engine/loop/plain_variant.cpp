// SPDX-License-Identifier: GPL-3.0-or-later

// The variants without SIMD: compiled once rather than once for each target, and for all
// restitution models together, since speed does not matter here.
#include <hwy/highway.h>

#include "engine/collision/smooth_collision.hpp"
#include "engine/loop/engine_variant-inl.hpp"
#include "engine/restitution/any_restitution_model.hpp"

namespace haff::engine {

std::unique_ptr<EngineVariant> plain_variant(const Model& model, const State& start) {
  return HWY_NAMESPACE::plain<HardSpheres>(SmoothCollision(AnyRestitutionModel(model)), start);
}

}  // namespace haff::engine
