// A course by its search and its law. Compiled once for each SIMD target, like the loop it runs.
#if defined(HAFF_ENGINE_COURSE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HAFF_ENGINE_COURSE_INL
#undef HAFF_ENGINE_COURSE_INL
#else
#define HAFF_ENGINE_COURSE_INL
#endif

#include "engine/course.hpp"
#include "engine/event_loop-inl.hpp"
#include "engine/laws.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

template <class Search, class Law, bool prefetching = false>
class CourseOf : public Course {
 public:
  CourseOf(const Law& law, const State& start) : law_(law) { law_.recall(start); }
  void run(Gas& gas, std::int64_t collisions, double end) override {
    EventLoop<Search, SmoothSpheres<Law>, prefetching>(gas, physics_).run(collisions, end);
  }
  void predict_all(Gas& gas) override {
    EventLoop<Search, SmoothSpheres<Law>>(gas, physics_).predict_all();
  }
  void store(State& state) const override { law_.store(state); }
  void before_synchronization(const Gas& gas) override {
    law_.before_synchronization(gas.particles, gas.clock.now);
  }
  void scale(int exponent) override { law_.scale(exponent); }

 private:
  Law law_;
  SmoothSpheres<Law> physics_{law_};
};

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
