// Compiled once for each SIMD target; the best one the processor has is chosen at run time.
#include "engine/simulation.hpp"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simulation.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/event_loop-inl.hpp"
#include "engine/laws.hpp"
#include "engine/search-inl.hpp"
#include "engine/soundness.hpp"

// Outside of the namespaces of targets: once.
#ifndef HAFF_ENGINE_COURSE
#define HAFF_ENGINE_COURSE
namespace haff::engine {

// From here on the particles do not fit in the second-level cache.
inline constexpr std::size_t worth_prefetching = 16000;

// What is chosen once per simulation: how to search, what a collision does.
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

}  // namespace haff::engine
#endif

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

template <class Search, class Law, bool prefetching = false>
class CourseOf : public Course {
 public:
  CourseOf(const Law& law, const State& start) : law_(law) { law_.recall(start); }
  void run(Gas& gas, std::int64_t collisions, double end) override {
    EventLoop<Search, SmoothSpheres<Law>, prefetching>(gas, physics_).run(collisions, end);
  }
  void predict_all(Gas& gas) override {
    EventLoop<Search, SmoothSpheres<Law>>(gas, physics_).predict_all();
  }
  void store(State& state) const override { law_.store(state); }
  void before_synchronization(const Gas& gas) override {
    law_.before_synchronization(gas.particles, gas.clock.now);
  }
  void scale(int exponent) override { law_.scale(exponent); }

 private:
  Law law_;
  SmoothSpheres<Law> physics_{law_};
};

template <class Law>
Course* course_by(const Law& law, const Gas& gas, const State& start, Prediction prediction) {
  if (!Bricks::fits(gas.box))
    return new CourseOf<PlainSearch<HardSpheres, Everybody>, Law>(law, start);
  if (!gas.bricks.tell_images_apart())
    return new CourseOf<PlainSearch<HardSpheres, NearImages>, Law>(law, start);
  if (prediction == Prediction::scalar)
    return new CourseOf<PlainSearch<HardSpheres>, Law>(law, start);
  if (gas.particles.size() < worth_prefetching) return new CourseOf<SimdSearch, Law>(law, start);
  return new CourseOf<SimdSearch, Law, true>(law, start);
}

// The course for the law the model asks for; nullptr if there is no such law.
Course* choose(const Model& model, const Gas& gas, const State& start, Prediction prediction) {
  Course* course = nullptr;
  const auto try_law = [&]<class Law>(const Law*) {
    if (Law::name == model.law.name)
      course = course_by(Law(model.restitution, model.law.parameters), gas, start, prediction);
  };
  [&]<class... Law>(const std::tuple<Law...>*) {
    (try_law(static_cast<const Law*>(nullptr)), ...);
  }(static_cast<const Laws*>(nullptr));
  return course;
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
  Implementation(const Model& model, const State& state, Prediction prediction)
      : gas(sound(state)), course(HWY_DYNAMIC_DISPATCH(choose)(model, gas, state, prediction)) {
    if (!course) throw std::invalid_argument("there is no law of restitution " + model.law.name);
    start(gas.particles, gas.clock);
    begin_period();
  }

  void run_to(std::int64_t collisions) {
    while (gas.clock.collisions < collisions) {
      const std::int64_t stop = std::min(collisions, next_stop);
      course->run(gas, stop, longest_period(count()) * expected);
      if (gas.clock.collisions < stop)
        throw Breakdown("the particles do not meet any more, after " +
                        std::to_string(gas.clock.collisions) + " collisions");
      if (gas.clock.collisions == next_stop) synchronize_now();
    }
  }

  std::uint32_t count() const { return static_cast<std::uint32_t>(gas.particles.size()); }

  Gas gas;
  std::unique_ptr<Course> course;
  double expected = 0;  // length of the period, in scaled time
  std::int64_t next_stop = 0;

 private:
  static const State& sound(const State& state) {
    if (const auto wrong = unsoundness(state)) throw Breakdown(*wrong);
    return state;
  }

  void synchronize_now() {
    must_have_progressed(gas, expected);
    const double volume = gas.box.side * gas.box.side * gas.box.side;
    audit(gas.particles, gas.clock, allowed_overlap(count() / volume, gas.clock.now / expected));
    course->before_synchronization(gas);
    synchronize(gas.particles, gas.clock, gas.box);
    begin_period();
  }

  // After a synchronization, at which every simulation begins.
  void begin_period() {
    course->scale(gas.clock.exponent);
    expected = expected_period(gas);
    next_stop = next_synchronization(gas.clock.collisions, count());
    prepare(gas);
    course->predict_all(gas);
  }
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
  return engine::take_tally(self_->gas.clock);
}

Invariants Simulation::invariants() const {
  return self_->gas.clock.invariants;
}

State Simulation::state() const {
  if (!synchronized()) throw std::logic_error("a state exists only at a synchronization");
  State state = to_state(self_->gas.particles, self_->gas.clock, self_->gas.box);
  self_->course->store(state);
  return state;
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
