// Rough spheres and disks. Their contacts are those of smooth ones, so SIMD looks for them, too:
// compiled once for each of its targets. Those of two species are found one candidate after the
// other.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/rough_course.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/course-inl.hpp"
#include "engine/rough_spheres.hpp"
#include "engine/search-inl.hpp"
#include "engine/two_species.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

std::unique_ptr<Course> simd_rough_spheres(const Model& model, const State& start) {
  RoughSpheres physics(model);
  if (start.d == 2)
    return std::make_unique<CourseOf<SimdSearch<2>, RoughSpheres<>>>(std::move(physics), start);
  if (start.id.size() < worth_prefetching)
    return std::make_unique<CourseOf<SimdSearch<3>, RoughSpheres<>>>(std::move(physics), start);
  return std::make_unique<CourseOf<SimdSearch<3>, RoughSpheres<>, true>>(std::move(physics), start);
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haff::engine {

HWY_EXPORT(simd_rough_spheres);

namespace {

template <class Bodies>
std::unique_ptr<Course> plain_rough(const Model& model, const Gas& gas, const State& start,
                                    Bodies bodies) {
  RoughSpheres physics(model, std::move(bodies));
  return start.d == 2 ? HWY_NAMESPACE::plain<Bodies, 2>(std::move(physics), gas, start)
                      : HWY_NAMESPACE::plain<Bodies, 3>(std::move(physics), gas, start);
}

}  // namespace

std::unique_ptr<Course> rough_course(const Model& model, const Gas& gas, const State& start,
                                     Prediction prediction) {
  if (model.effects.contains("mixture"))
    return plain_rough(model, gas, start, TwoSpecies(model, start));
  if (prediction == Prediction::simd && gas.tells_images_apart())
    return HWY_DYNAMIC_DISPATCH(simd_rough_spheres)(model, start);
  return plain_rough(model, gas, start, HardSpheres());
}

}  // namespace haff::engine
#endif
