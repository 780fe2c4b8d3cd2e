// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "engine/actions/actions.hpp"
#include "engine/collision/pair_geometry.hpp"
#include "engine/loop/engine_variant.hpp"
#include "engine/loop/watchdog.hpp"
#include "engine/parallel/slabs.hpp"
#include "engine/particles/synchronize.hpp"
#include "engine/soundness.hpp"

namespace haff::engine {

namespace {

// The names under which a state's memory keeps properties of the particles (mixture.cpp,
// rough_collision.hpp).
constexpr std::array<std::string_view, 2> of_particles{"mixture", "spin"};

bool is_effect(std::string_view name) {
  return is_action(name) || std::any_of(other_physics.begin(), other_physics.end(),
                                        [&](const auto& other) { return other.effect == name; });
}

}  // namespace

class Simulation::Implementation {
 public:
  Implementation(const Model& model, const State& state, SearchBackend backend,
                 const Threads& threads)
      : gas(sound(state)),
        variant(choose(model, gas, state, backend, threads)),
        actions(actions_of(model, state)) {
    for (const auto& [name, parameters] : model.effects)
      if (!is_effect(name)) throw std::invalid_argument("there is no effect " + name);
    variant->start(gas);
    begin_period();
  }

  // Returns whether the run stopped at the true time.
  bool run_to(std::int64_t collisions, double time) {
    while (gas.clock.collisions < collisions) {
      const std::int64_t stop = std::min(collisions, next_stop);
      const double longest = longest_period(count()) * expected;
      const double end = std::max(gas.clock.now, gas.clock.scaled(time));
      variant->run(gas, stop, std::min(longest, end));
      if (gas.clock.collisions < stop) {
        if (end <= longest) return true;
        throw PhysicsError("the particles do not meet any more, after " +
                           std::to_string(gas.clock.collisions) + " collisions");
      }
      if (gas.clock.collisions == next_stop) synchronize_now();
    }
    return false;
  }

  std::uint32_t count() const { return static_cast<std::uint32_t>(gas.particles.size()); }

  Gas gas;
  std::unique_ptr<EngineVariant> variant;
  std::vector<std::unique_ptr<Action>> actions;
  double expected = 0;  // length of a synchronization_period, in scaled time
  std::int64_t next_stop = 0;

 private:
  static const State& sound(const State& state) {
    if (const auto wrong = unsoundness(state)) throw std::invalid_argument(*wrong);
    return state;
  }

  static std::unique_ptr<EngineVariant> choose(const Model& model, Gas& gas, const State& state,
                                               SearchBackend backend, const Threads& threads) {
    if (mixture_in(state) && !model.effects.contains("mixture"))
      throw std::invalid_argument("the state is of a mixture, and the model asks for none");
    if (model.counts_collisions) return observed_variant(model, gas, state, backend);
    if (const unsigned slabs = Slabs::most(gas.bricks, std::max(threads.count, threads.slabs));
        slabs > 1 && backend == SearchBackend::simd && gas.tells_images_apart()) {
      gas.team.grow(std::min(threads.count, slabs));
      return parallel_variant(model, state, threads);
    }
    for (const OtherPhysics& other : other_physics)
      if (model.effects.contains(std::string(other.effect)))
        return other.make(model, gas, state, backend);
    if (backend == SearchBackend::scalar || !gas.tells_images_apart())
      return plain_variant(model, state);
    if (gas.box.d == 2) return disks_variant(model, state);
    return spheres_variant(model, gas, state);
  }

  void synchronize_now() {
    if (is_long) must_have_progressed(gas, expected);
    variant->audit(
        gas, allowed_overlap(count() / gas.box.volume(), gas.clock.now / expected, gas.box.d));
    variant->synchronize(gas);
    if (act(actions, gas.particles, gas.clock)) variant->start(gas);
    begin_period();
  }

  // Called after a synchronization; every simulation begins with one.
  void begin_period() {
    variant->scale(gas.clock.exponent);
    expected = expected_period(gas);
    next_stop = next_synchronization(gas.clock.collisions, count());
    for (const auto& action : actions)
      next_stop = std::min(next_stop, action->next(gas.clock.collisions, count()));
    is_long = next_stop - gas.clock.collisions > count();
    prepare(gas);
    variant->predict_all(gas);
  }

  // Whether the stretch up to next_stop must take time. A few collisions need not: an action can
  // send two particles that have just collided towards each other again, and then they collide at
  // once.
  bool is_long = false;
};

std::int64_t collisions_at(double tau, std::uint32_t particles) {
  return static_cast<std::int64_t>(std::ceil(tau * particles / 2));
}

Simulation::Simulation(const Model& model, const State& start, SearchBackend backend,
                       const Threads& threads)
    : self_(std::make_unique<Implementation>(model, start, backend, threads)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::run_to(std::int64_t collisions) {
  self_->run_to(collisions, std::numeric_limits<double>::infinity());
}
bool Simulation::run_to(std::int64_t collisions, double time) {
  return self_->run_to(collisions, time);
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
  const auto rotation = self_->variant->rotation();
  return rotation ? std::optional(rotation->now) : std::nullopt;
}

Tally Simulation::take_tally() {
  return engine::take_tally(self_->gas.clock);
}

std::optional<CollisionCounts> Simulation::take_collision_counts() {
  return self_->variant->take_collision_counts();
}

Invariants Simulation::invariants() const {
  return self_->gas.clock.invariants;
}

State Simulation::state() const {
  if (!synchronized()) throw std::logic_error("a state exists only at a synchronization");
  State state = to_state(self_->gas.particles, self_->gas.clock, self_->gas.box);
  self_->variant->store(state);
  for (const auto& action : self_->actions) action->store(state);
  return state;
}

State Simulation::snapshot() const {
  const Gas& gas = self_->gas;
  State state = to_state(gas.particles, gas.clock, gas.box);
  self_->variant->store(state);
  std::erase_if(state.memory, [](const auto& remembered) {
    return std::ranges::find(of_particles, remembered.first) == of_particles.end();
  });
  state.position = positions();
  state.time = time();
  state.tally = {};
  return state;
}

std::optional<Windows> Simulation::windows() const {
  return self_->variant->windows();
}

Events Simulation::events() const {
  return self_->gas.events;
}

std::size_t Simulation::memory() const {
  const Gas& gas = self_->gas;
  return gas.particles.capacity() * sizeof(Particle) + gas.bricks.memory() + gas.queue.memory() +
         self_->variant->memory();
}

}  // namespace haff::engine
