// Mixtures of two species. Compiled once for each SIMD target, for all laws at once.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/mixture_course.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/any_law.hpp"
#include "engine/course-inl.hpp"
#include "engine/search-inl.hpp"
#include "engine/two_species.hpp"

namespace haff::engine {
using SmoothMixture = SmoothSpheres<AnyLaw, TwoSpecies>;
}

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

std::unique_ptr<Course> simd_mixture(const Model& model, const State& start) {
  SmoothMixture physics(AnyLaw(model), TwoSpecies(model, start));
  if (start.d == 2)
    return std::make_unique<CourseOf<SimdSearch<2, TwoSpecies>, SmoothMixture>>(std::move(physics),
                                                                                start);
  return std::make_unique<CourseOf<SimdSearch<3, TwoSpecies>, SmoothMixture>>(std::move(physics),
                                                                              start);
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haff::engine {

HWY_EXPORT(simd_mixture);

std::unique_ptr<Course> mixture_course(const Model& model, const Gas& gas, const State& start,
                                       Prediction prediction) {
  if (prediction == Prediction::simd && gas.tells_images_apart())
    return HWY_DYNAMIC_DISPATCH(simd_mixture)(model, start);
  SmoothMixture physics(AnyLaw(model), TwoSpecies(model, start));
  return gas.box.d == 2 ? HWY_NAMESPACE::plain<TwoSpecies, 2>(std::move(physics), gas, start)
                        : HWY_NAMESPACE::plain<TwoSpecies, 3>(std::move(physics), gas, start);
}

}  // namespace haff::engine
#endif
