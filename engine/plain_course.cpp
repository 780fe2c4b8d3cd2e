// The courses that need no SIMD: compiled once, apart from those that are once for each target, and
// for all laws at once, of whom none is in a hurry here.
#include <hwy/highway.h>

#include "engine/any_law.hpp"
#include "engine/course-inl.hpp"

namespace haff::engine {

std::unique_ptr<Course> plain_course(const Model& model, const Gas& gas, const State& start) {
  SmoothSpheres physics{AnyLaw(model)};
  return gas.box.d == 2 ? HWY_NAMESPACE::plain<HardSpheres, 2>(std::move(physics), gas, start)
                        : HWY_NAMESPACE::plain<HardSpheres, 3>(std::move(physics), gas, start);
}

}  // namespace haff::engine
