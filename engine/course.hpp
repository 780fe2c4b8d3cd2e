// What is chosen once per simulation: how to search, what a collision does. Each choice is compiled
// as an event loop of its own, and behind this interface they look alike.
#pragma once

#include <memory>

#include "engine/gas.hpp"
#include "engine/simulation.hpp"

namespace haff::engine {

class Course {
 public:
  virtual ~Course() = default;
  virtual void run(Gas& gas, std::int64_t collisions, double end) = 0;
  virtual void predict_all(Gas& gas) = 0;
  // What the law of restitution remembers: see Forgetful.
  virtual void store(State& state) const = 0;
  virtual void before_synchronization(const Gas& gas) = 0;
  virtual void scale(int exponent) = 0;
};

// Without SIMD: for boxes too small to tell images apart, and to compare.
// Throws std::invalid_argument if there is no such law.
std::unique_ptr<Course> plain_course(const Model& model, const Gas& gas, const State& start);

// Disks, by SIMD. Throws likewise.
std::unique_ptr<Course> disks_course(const Model& model, const State& start);

}  // namespace haff::engine
