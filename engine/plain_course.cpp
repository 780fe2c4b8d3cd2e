// The courses that need no SIMD: compiled once, apart from those that are once for each target.
#include <hwy/highway.h>

#include "engine/course-inl.hpp"

namespace haff::engine {

std::unique_ptr<Course> plain_course(const Model& model, const Gas& gas, const State& start) {
  using HWY_NAMESPACE::CourseOf;
  return with_law(model, [&]<class Law>(const Law& law) -> std::unique_ptr<Course> {
    if (!Bricks::fits(gas.box))
      return std::make_unique<CourseOf<PlainSearch<HardSpheres, Everybody>, Law>>(law, start);
    if (!gas.bricks.tell_images_apart())
      return std::make_unique<CourseOf<PlainSearch<HardSpheres, NearImages>, Law>>(law, start);
    return std::make_unique<CourseOf<PlainSearch<HardSpheres>, Law>>(law, start);
  });
}

}  // namespace haff::engine
