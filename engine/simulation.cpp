// Compiled once for each SIMD target; the best one the processor has is chosen at run time.
#include "engine/simulation.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simulation.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/actions.hpp"
#include "engine/course-inl.hpp"
#include "engine/search-inl.hpp"
#include "engine/soundness.hpp"

HWY_BEFORE_NAMESPACE();
namespace haff::engine::HWY_NAMESPACE {

std::unique_ptr<Course> simd_course(const Model& model, const Gas& gas, const State& start) {
  return with_law(model, [&]<class Law>(const Law& law) -> std::unique_ptr<Course> {
    using Physics = SmoothSpheres<Law>;
    if (gas.particles.size() < worth_prefetching)
      return std::make_unique<CourseOf<SimdSearch<3>, Physics>>(Physics(law), start);
    return std::make_unique<CourseOf<SimdSearch<3>, Physics, true>>(Physics(law), start);
  });
}

const char* target_name() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace haff::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haff::engine {

HWY_EXPORT(simd_course);
HWY_EXPORT(target_name);

namespace {

bool is_effect(std::string_view name) {
  return is_action(name) || std::any_of(other_physics.begin(), other_physics.end(),
                                        [&](const auto& other) { return other.effect == name; });
}

}  // namespace

class Simulation::Implementation {
 public:
  Implementation(const Model& model, const State& state, Prediction prediction)
      : gas(sound(state)),
        course(choose(model, gas, state, prediction)),
        actions(actions_of(model, state)) {
    for (const auto& [name, parameters] : model.effects)
      if (!is_effect(name)) throw std::invalid_argument("there is no effect " + name);
    course->start(gas);
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
  std::vector<std::unique_ptr<Action>> actions;
  double expected = 0;  // length of a synchronization_period, in scaled time
  std::int64_t next_stop = 0;

 private:
  static const State& sound(const State& state) {
    if (const auto wrong = unsoundness(state)) throw Breakdown(*wrong);
    return state;
  }

  static std::unique_ptr<Course> choose(const Model& model, const Gas& gas, const State& state,
                                        Prediction prediction) {
    for (const OtherPhysics& other : other_physics)
      if (model.effects.contains(std::string(other.effect)))
        return other.course(model, gas, state, prediction);
    if (mixture_in(state))
      throw std::invalid_argument("the state is of a mixture, and the model asks for none");
    if (prediction == Prediction::scalar || !gas.tells_images_apart())
      return plain_course(model, gas, state);
    if (gas.box.d == 2) return disks_course(model, state);
    return HWY_DYNAMIC_DISPATCH(simd_course)(model, gas, state);
  }

  void synchronize_now() {
    if (is_long) must_have_progressed(gas, expected);
    course->audit(gas,
                  allowed_overlap(count() / gas.box.volume(), gas.clock.now / expected, gas.box.d));
    course->synchronize(gas);
    if (act(actions, gas.particles, gas.clock)) course->start(gas);
    begin_period();
  }

  // After a synchronization, at which every simulation begins.
  void begin_period() {
    course->scale(gas.clock.exponent);
    expected = expected_period(gas);
    next_stop = next_synchronization(gas.clock.collisions, count());
    for (const auto& action : actions)
      next_stop = std::min(next_stop, action->next(gas.clock.collisions, count()));
    is_long = next_stop - gas.clock.collisions > count();
    prepare(gas);
    course->predict_all(gas);
  }

  // Whether the stretch up to next_stop must take time. A few collisions need not: an action can
  // send those who have just collided at each other again, at once.
  bool is_long = false;
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

std::vector<std::uint32_t> Simulation::ids() const {
  std::vector<std::uint32_t> all;
  all.reserve(particles());
  for (const Particle& p : self_->gas.particles) all.push_back(p.id);
  return all;
}

std::optional<double> Simulation::rotational_energy() const {
  const auto rotation = self_->course->rotation();
  return rotation ? std::optional(rotation->now) : std::nullopt;
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
  for (const auto& action : self_->actions) action->store(state);
  return state;
}

Events Simulation::events() const {
  return self_->gas.events;
}

std::size_t Simulation::memory() const {
  const Gas& gas = self_->gas;
  return gas.particles.capacity() * sizeof(Particle) + gas.bricks.memory() + gas.calendar.memory() +
         self_->course->memory();
}

}  // namespace haff::engine
#endif
