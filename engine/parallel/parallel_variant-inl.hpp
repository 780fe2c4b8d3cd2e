// SPDX-License-Identifier: GPL-3.0-or-later

// An engine variant that runs on several threads.
//
// Compiled once for each SIMD target, like the loop that it runs.
#if defined(HAFF_ENGINE_PARALLEL_VARIANT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAFF_ENGINE_PARALLEL_VARIANT_INL
#undef HAFF_ENGINE_PARALLEL_VARIANT_INL
#else
#define HAFF_ENGINE_PARALLEL_VARIANT_INL
#endif

#include <memory>

#include "engine/loop/physics_variant.hpp"
#include "engine/parallel/one_piece_loop-inl.hpp"
#include "engine/parallel/parallel_loop.hpp"
#include "engine/parallel/slab_loop-inl.hpp"
#include "engine/parallel/zone_loop-inl.hpp"
#include "engine/search/called_search-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

// `SlabSearch` is the search of slabs and zones; `Search` is used in the rare stretches in one
// piece.
template <class Physics, class Search, class SlabSearch = Search>
class ParallelVariantOf : public PhysicsVariant<Physics>, public LoopMaker {
 public:
  ParallelVariantOf(Physics physics, const State& start, const Threads& threads)
      : PhysicsVariant<Physics>(std::move(physics), start), threads_(threads) {}

  void run(Gas&, std::int64_t collisions, double end) override { loop_->run(collisions, end); }
  void predict_all(Gas& gas) override {
    if (!loop_) loop_ = std::make_unique<ParallelLoop>(gas, *this, threads_);
    loop_->predict_all();
  }
  std::optional<Windows> windows() const override { return loop_->windows(); }
  std::size_t memory() const override {
    return PhysicsVariant<Physics>::memory() + loop_->memory();
  }

 private:
  std::unique_ptr<AnySlabLoop> slab_loop(Gas& gas, Region& region) override {
    return std::make_unique<SlabLoop<SlabSearch, Physics>>(gas, this->physics_, region);
  }
  std::unique_ptr<AnyZoneLoop> zone_loop(Gas& gas, Region& region) override {
    return std::make_unique<ZoneLoop<SlabSearch, Physics>>(gas, this->physics_, region);
  }
  std::unique_ptr<AnyOnePieceLoop> one_piece_loop(Gas& gas, Region& region) override {
    return std::make_unique<OnePieceLoop<Search, Physics>>(gas, this->physics_, region);
  }

  Threads threads_;
  std::unique_ptr<ParallelLoop> loop_;
};

template <class PairGeometry, class Physics>
std::unique_ptr<EngineVariant> on_threads(Physics physics, const State& start,
                                          const Threads& threads) {
  return std::make_unique<ParallelVariantOf<Physics, CalledSearch<PairGeometry>>>(
      std::move(physics), start, threads);
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
