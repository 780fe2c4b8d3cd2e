// What is chosen once per simulation: how to search, what a collision does. Each choice is compiled
// as an event loop of its own, and behind this interface they look alike.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string_view>

#include "engine/gas.hpp"
#include "engine/simulation.hpp"

namespace haff::engine {

class Course {
 public:
  virtual ~Course() = default;
  virtual void run(Gas& gas, std::int64_t collisions, double end) = 0;
  virtual void predict_all(Gas& gas) = 0;
  // See synchronize.hpp.
  virtual void start(Gas& gas) = 0;
  virtual void audit(Gas& gas, double allowed_overlap) = 0;
  virtual void synchronize(Gas& gas) = 0;
  // What the physics remembers: see Forgetful.
  virtual void store(State& state) const = 0;
  virtual void scale(int exponent) = 0;
  virtual std::optional<Rotation> rotation() const = 0;
  virtual std::size_t memory() const = 0;  // bytes, beside the gas
};

// Without SIMD: for boxes too small to tell images apart, and to compare.
// Throws std::invalid_argument if there is no such law.
std::unique_ptr<Course> plain_course(const Model& model, const Gas& gas, const State& start);

// Disks, by SIMD. Throws likewise.
std::unique_ptr<Course> disks_course(const Model& model, const State& start);

// Physics other than smooth spheres, by the effect that asks for it. Goes with any law. Throws
// std::invalid_argument if a parameter is missing or the state is none of its own.
struct OtherPhysics {
  std::string_view effect;
  std::unique_ptr<Course> (*course)(const Model&, const Gas&, const State&, Prediction);
};

std::unique_ptr<Course> rough_course(const Model& model, const Gas& gas, const State& start,
                                     Prediction prediction);
std::unique_ptr<Course> mixture_course(const Model& model, const Gas& gas, const State& start,
                                       Prediction prediction);

inline constexpr std::array<OtherPhysics, 2> other_physics{{
    {"roughness", rough_course},
    {"mixture", mixture_course},
}};

}  // namespace haff::engine
