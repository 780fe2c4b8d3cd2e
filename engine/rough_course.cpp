// Rough spheres. Their contacts are those of smooth ones, so SIMD looks for them, too: compiled
// once for each of its targets.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/rough_course.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/course-inl.hpp"
#include "engine/rough_spheres.hpp"
#include "engine/search-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

std::unique_ptr<Course> simd_rough_spheres(const Model& model, const State& start) {
  if (start.id.size() < worth_prefetching)
    return std::make_unique<CourseOf<SimdSearch<3>, RoughSpheres>>(RoughSpheres(model), start);
  return std::make_unique<CourseOf<SimdSearch<3>, RoughSpheres, true>>(RoughSpheres(model), start);
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haff::engine {

HWY_EXPORT(simd_rough_spheres);

std::unique_ptr<Course> rough_course(const Model& model, const Gas& gas, const State& start,
                                     Prediction prediction) {
  if (gas.box.d != 3) throw std::invalid_argument("roughness is of spheres: d = 3");
  // Everybody is right in any box, and few in one where the nearest image is in doubt.
  if (!gas.bricks.tell_images_apart())
    return std::make_unique<
        HWY_NAMESPACE::CourseOf<PlainSearch<HardSpheres, Everybody>, RoughSpheres>>(
        RoughSpheres(model), start);
  if (prediction == Prediction::scalar)
    return std::make_unique<HWY_NAMESPACE::CourseOf<PlainSearch<HardSpheres>, RoughSpheres>>(
        RoughSpheres(model), start);
  return HWY_DYNAMIC_DISPATCH(simd_rough_spheres)(model, start);
}

}  // namespace haff::engine
#endif
