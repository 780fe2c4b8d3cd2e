// Compiled once for each SIMD target; the best one the processor has is chosen at run time.
#include "engine/simulation.hpp"

#include <cmath>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simulation.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/event_loop-inl.hpp"
#include "engine/search-inl.hpp"

// From here on the particles do not fit in the second-level cache.
#ifndef HAFF_ENGINE_WORTH_PREFETCHING
#define HAFF_ENGINE_WORTH_PREFETCHING
namespace haff::engine {
inline constexpr std::size_t worth_prefetching = 16000;

template <class Physics>
struct EventLoops {
  void (*run)(Gas&, const Physics&, std::int64_t);
  void (*predict_all)(Gas&, const Physics&);
};
}  // namespace haff::engine
#endif

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

// What is chosen once per simulation: how to search, what a collision does.
template <class Search, class Physics, bool prefetching = false>
struct Course {
  static void run(Gas& gas, const Physics& physics, std::int64_t collisions) {
    EventLoop<Search, Physics, prefetching>(gas, physics).run(collisions);
  }
  static void predict_all(Gas& gas, const Physics& physics) {
    EventLoop<Search, Physics>(gas, physics).predict_all();
  }
};

template <class Course>
EventLoops<InelasticSpheres> loops_of() {
  return {Course::run, Course::predict_all};
}

EventLoops<InelasticSpheres> choose(const Gas& gas, Prediction prediction) {
  using Physics = InelasticSpheres;
  if (!Bricks::fits(gas.box)) return loops_of<Course<PlainSearch<Physics, Everybody>, Physics>>();
  if (!gas.bricks.tell_images_apart())
    return loops_of<Course<PlainSearch<Physics, NearImages>, Physics>>();
  if (prediction == Prediction::scalar) return loops_of<Course<PlainSearch<Physics>, Physics>>();
  if (gas.particles.size() < worth_prefetching) return loops_of<Course<SimdSearch, Physics>>();
  return loops_of<Course<SimdSearch, Physics, true>>();
}

const char* target_name() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haff::engine {

HWY_EXPORT(choose);
HWY_EXPORT(target_name);

class Simulation::Implementation {
 public:
  Implementation(const Model& model, const State& start, Prediction prediction)
      : gas(start),
        physics{.restitution = model.restitution},
        loops(HWY_DYNAMIC_DISPATCH(choose)(gas, prediction)),
        next_stop(next_synchronization(start.collisions, start.particles())) {
    prepare(gas);
    loops.predict_all(gas, physics);
  }

  void run_to(std::int64_t collisions) {
    while (gas.clock.collisions < collisions) {
      loops.run(gas, physics, std::min(collisions, next_stop));
      if (gas.clock.collisions == next_stop) synchronize_now();
    }
  }

  void synchronize_now() {
    synchronize(gas.particles, gas.clock, gas.box);
    next_stop = next_synchronization(gas.clock.collisions, count());
    prepare(gas);
    loops.predict_all(gas, physics);
  }

  std::uint32_t count() const { return static_cast<std::uint32_t>(gas.particles.size()); }

  Gas gas;
  InelasticSpheres physics;
  EventLoops<InelasticSpheres> loops;
  std::int64_t next_stop;
};

std::int64_t collisions_at(double tau, std::uint32_t particles) {
  return static_cast<std::int64_t>(std::ceil(tau * particles / 2));
}

std::string simd_target() {
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

Simulation::Simulation(const Model& model, const State& start, Prediction prediction)
    : self_(std::make_unique<Implementation>(model, start, prediction)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::run_to(std::int64_t collisions) {
  self_->run_to(collisions);
}
std::uint32_t Simulation::particles() const {
  return self_->count();
}
std::int64_t Simulation::collisions() const {
  return self_->gas.clock.collisions;
}
double Simulation::time() const {
  return self_->gas.clock.time();
}
bool Simulation::synchronized() const {
  return self_->gas.clock.now == 0;
}
int Simulation::exponent() const {
  return self_->gas.clock.exponent;
}

std::vector<Vector> Simulation::velocities() const {
  std::vector<Vector> all;
  all.reserve(particles());
  for (const Particle& p : self_->gas.particles) all.push_back(p.velocity);
  return all;
}

std::vector<Vector> Simulation::positions() const {
  std::vector<Vector> all;
  all.reserve(particles());
  for (Particle p : self_->gas.particles) {
    advance(p, self_->gas.clock.now);
    all.push_back(wrapped(p.position, self_->gas.box));
  }
  return all;
}

Tally Simulation::take_tally() {
  Clock& clock = self_->gas.clock;
  const Tally scaled = std::exchange(clock.tally, {});
  return {.dissipated = std::ldexp(scaled.dissipated, -2 * clock.exponent),
          .virial = std::ldexp(scaled.virial, -clock.exponent)};
}

State Simulation::state() const {
  if (!synchronized()) throw std::logic_error("a state exists only at a synchronization");
  return to_state(self_->gas.particles, self_->gas.clock, self_->gas.box);
}

Events Simulation::events() const {
  return self_->gas.events;
}

std::size_t Simulation::memory() const {
  const Gas& gas = self_->gas;
  return gas.particles.capacity() * sizeof(Particle) + gas.bricks.memory() + gas.calendar.memory();
}

}  // namespace haff::engine
#endif
