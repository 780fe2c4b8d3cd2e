// SPDX-License-Identifier: GPL-3.0-or-later

// An engine variant, made from a search and a physics. Compiled once for each SIMD target, like the
// loop that it runs.
#if defined(HAFF_ENGINE_VARIANT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAFF_ENGINE_VARIANT_INL
#undef HAFF_ENGINE_VARIANT_INL
#else
#define HAFF_ENGINE_VARIANT_INL
#endif

#include "engine/loop/event_loop-inl.hpp"
#include "engine/loop/physics_variant.hpp"
#include "engine/search/any_plain_search.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

template <class Search, class Physics, bool prefetching = false>
class VariantOf : public PhysicsVariant<Physics> {
 public:
  using PhysicsVariant<Physics>::PhysicsVariant;

  void run(Gas& gas, std::int64_t collisions, double end) override {
    EventLoop<Search, Physics, prefetching>(gas, this->physics_).run(collisions, end);
  }
  void predict_all(Gas& gas) override {
    EventLoop<Search, Physics>(gas, this->physics_).predict_all();
  }
};

// The variant without SIMD.
template <class PairGeometry, class Physics>
std::unique_ptr<EngineVariant> plain(Physics physics, const State& start) {
  return std::make_unique<VariantOf<AnyPlainSearch<PairGeometry>, Physics>>(std::move(physics),
                                                                            start);
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
