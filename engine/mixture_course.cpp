// Mixtures, one candidate after the other: spheres of two sizes have a contact time of their own.
#include <hwy/highway.h>

#include "engine/course-inl.hpp"
#include "engine/sphere_mixture.hpp"

namespace haff::engine {

std::unique_ptr<Course> mixture_course(const Model& model, const Gas& gas, const State& start,
                                       Prediction) {
  using HWY_NAMESPACE::CourseOf;
  if (gas.box.d != 3) throw std::invalid_argument("a mixture is of spheres: d = 3");
  SphereMixture spheres(model, start.particles());
  // Everybody is right in any box, and few in one where the nearest image is in doubt.
  if (!gas.bricks.tell_images_apart())
    return std::make_unique<CourseOf<PlainSearch<SpheresOfTwoSizes, Everybody>, SphereMixture>>(
        std::move(spheres), start);
  return std::make_unique<CourseOf<PlainSearch<SpheresOfTwoSizes>, SphereMixture>>(
      std::move(spheres), start);
}

}  // namespace haff::engine
