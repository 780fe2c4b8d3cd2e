// The courses that need no SIMD: compiled once, apart from those that are once for each target.
#include <hwy/highway.h>

#include "engine/course-inl.hpp"

namespace haff::engine {
namespace {

template <int d>
std::unique_ptr<Course> plain_course_in(const Model& model, const Gas& gas, const State& start) {
  using HWY_NAMESPACE::CourseOf;
  return with_law(model, [&]<class Law>(const Law& law) -> std::unique_ptr<Course> {
    if (!Bricks::fits(gas.box))
      return std::make_unique<CourseOf<PlainSearch<HardSpheres, Everybody, d>, SmoothSpheres<Law>>>(
          SmoothSpheres(law), start);
    if (!gas.bricks.tell_images_apart())
      return std::make_unique<
          CourseOf<PlainSearch<HardSpheres, NearImages, d>, SmoothSpheres<Law>>>(SmoothSpheres(law),
                                                                                 start);
    return std::make_unique<CourseOf<PlainSearch<HardSpheres, Near, d>, SmoothSpheres<Law>>>(
        SmoothSpheres(law), start);
  });
}

}  // namespace

std::unique_ptr<Course> plain_course(const Model& model, const Gas& gas, const State& start) {
  return gas.box.d == 2 ? plain_course_in<2>(model, gas, start)
                        : plain_course_in<3>(model, gas, start);
}

}  // namespace haff::engine
