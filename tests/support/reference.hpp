// SPDX-License-Identifier: GPL-3.0-or-later

// A naive reference engine: every pair, every image in reach, at every event. It is slow and
// evidently right; the real engine must agree with it event by event and bit by bit.
//
// It shares the definition of a contact, a collision and a synchronization (engine/collision,
// engine/particles/synchronize.hpp), the restitution models and the actions, and nothing else: no
// cells, no event queue, no SIMD.
#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "engine/actions/actions.hpp"
#include "engine/collision/smooth_collision.hpp"
#include "engine/particles/synchronize.hpp"
#include "engine/restitution/restitution_models.hpp"
#include "engine/simulation.hpp"

namespace haff::tests {

template <class Physics>
class ReferenceOf {
 public:
  ReferenceOf(Physics physics, const engine::Model& model, const engine::State& state)
      : physics_(std::move(physics)),
        box_(state),
        particles_(state.particles()),
        actions_(engine::actions_of(model, state)),
        clock_(engine::to_clock(state)) {
    engine::copy_particles(state, particles_);
    physics_.recall(state);
    engine::start(particles_, clock_, physics_.masses());
    physics_.scale(clock_.exponent);
  }

  // The next collision.
  void step() {
    for (;;) {
      double fastest = 0;
      for (const auto& p : particles_)
        fastest = std::max(fastest, engine::dot(p.velocity, p.velocity));
      // Until then no particle moves by more than a quarter of the box relative to another, so the
      // contact is with one of the 27 images around the nearest (of disks 9). All but the nearest
      // are half a box away or more: in a box whose quarter is longer than a contact distance (1)
      // they are out of reach.
      const double horizon = clock_.now + 0.125 * box_.side / std::sqrt(fastest);
      const int images = box_.side > 5 ? 1 : box_.d == 2 ? 9 : 27;
      // Events are ordered by time, then by the smaller and by the larger id.
      auto first = std::tuple(engine::never, 0u, 0u);
      std::size_t a = 0, b = 0;
      for (std::size_t i = 0; i < particles_.size(); ++i)
        for (std::size_t j = i + 1; j < particles_.size(); ++j)
          for (int image = 0; image < images; ++image) {
            engine::Vector boxes{};
            if (images > 1)
              boxes = {image % 3 - 1.0, image / 3 % 3 - 1.0, box_.d == 2 ? 0 : image / 9 - 1.0};
            const double time = physics_.contact_time(
                engine::Encounter(particles_[i], particles_[j], clock_.now, box_, boxes),
                particles_[i], particles_[j]);
            const auto ids = std::minmax(particles_[i].id, particles_[j].id);
            if (const auto found = std::tuple(time, ids.first, ids.second); found < first) {
              first = found;
              a = i;
              b = j;
            }
          }
      if (std::get<0>(first) > horizon) {
        clock_.now = horizon;
        continue;
      }
      clock_.now = std::max(clock_.now, std::get<0>(first));
      physics_.collide(particles_[a], particles_[b], clock_.now, box_, clock_);
      break;
    }
    if (++clock_.collisions == next_) synchronize();
  }

  bool synchronized() const { return clock_.now == 0; }
  engine::State state() const {
    engine::State state = engine::to_state(particles_, clock_, box_);
    physics_.store(state);
    for (const auto& action : actions_) action->store(state);
    return state;
  }
  double time() const { return clock_.time(); }
  double rotational_energy() const { return physics_.rotation()->now; }
  std::vector<engine::Vector> velocities() const {
    std::vector<engine::Vector> all;
    for (const auto& p : particles_) all.push_back(p.velocity);
    return all;
  }

 private:
  void synchronize() {
    constexpr double overlap = 1e-9;  // sigma: boxes are small, periods may be long
    engine::audit(particles_, clock_, overlap, physics_.masses(),
                  physics_.rotation().value_or(engine::Rotation{}));
    physics_.before_synchronization(particles_, clock_.now);
    engine::synchronize(particles_, clock_, box_, physics_.masses());
    if (engine::act(actions_, particles_, clock_))
      engine::start(particles_, clock_, physics_.masses());
    physics_.scale(clock_.exponent);
    next_ = next_stop();
  }

  std::int64_t next_stop() const {
    auto next = engine::next_synchronization(clock_.collisions, particles_.size());
    for (const auto& action : actions_)
      next = std::min(next, action->next(clock_.collisions, particles_.size()));
    return next;
  }

  Physics physics_;
  engine::Box box_;
  std::vector<engine::Particle> particles_;
  std::vector<std::unique_ptr<engine::Action>> actions_;
  engine::Clock clock_;
  std::int64_t next_ = next_stop();
};

// Smooth spheres.
template <class RestitutionModel = engine::ConstantRestitution>
class Reference : public ReferenceOf<engine::SmoothCollision<RestitutionModel>> {
 public:
  Reference(const engine::Model& model, const engine::State& state)
      : ReferenceOf<engine::SmoothCollision<RestitutionModel>>(
            engine::SmoothCollision<RestitutionModel>(
                RestitutionModel(model.restitution, model.law.parameters)),
            model, state) {}
};

}  // namespace haff::tests
