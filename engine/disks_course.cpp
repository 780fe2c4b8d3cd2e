// Disks by SIMD. Compiled once for each SIMD target, like the spheres of simulation.cpp; apart from
// those, so that the two compile side by side.
#include "engine/course.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/disks_course.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/course-inl.hpp"
#include "engine/search-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

std::unique_ptr<Course> simd_disks(const Model& model, const State& start) {
  return with_law(model, [&]<class Law>(const Law& law) -> std::unique_ptr<Course> {
    return std::make_unique<CourseOf<SimdSearch<2>, SmoothSpheres<Law>>>(SmoothSpheres(law), start);
  });
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haff::engine {

HWY_EXPORT(simd_disks);

std::unique_ptr<Course> disks_course(const Model& model, const State& start) {
  return HWY_DYNAMIC_DISPATCH(simd_disks)(model, start);
}

}  // namespace haff::engine
#endif
