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

#include "engine/loop/engine_variant-inl.hpp"
#include "engine/parallel/parallel_loop-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

template <class Search, class Physics, int dimension>
class ParallelVariantOf : public VariantOf<Search, Physics> {
  using Serial = VariantOf<Search, Physics>;

 public:
  ParallelVariantOf(Physics physics, const State& start, const Threads& threads)
      : Serial(std::move(physics), start), threads_(threads) {}

  void run(Gas& gas, std::int64_t collisions, double end) override {
    loop_->run(collisions, end);
    static_cast<void>(gas);
  }
  void predict_all(Gas& gas) override {
    if (!loop_) loop_ = std::make_unique<Loop>(gas, this->physics_, threads_);
    loop_->predict_all();
  }
  std::optional<Windows> windows() const override { return loop_->windows(); }
  std::size_t memory() const override { return Serial::memory() + loop_->memory(); }

 private:
  using Loop = ParallelLoop<Search, Physics, dimension, true>;
  Threads threads_;
  std::unique_ptr<Loop> loop_;
};

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
