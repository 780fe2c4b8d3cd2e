// SPDX-License-Identifier: GPL-3.0-or-later

// The collision rule that a model asks for, smooth or rough, chosen at run time. It serves event
// loops whose collisions cost more than a virtual call.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "engine/collision/rough_collision.hpp"
#include "engine/restitution/any_restitution_model.hpp"

namespace haff::engine {

template <class PairGeometry = HardSpheres>
class AnyCollision : public PairGeometry {
 public:
  // Throws std::invalid_argument if the model lacks a parameter.
  explicit AnyCollision(const Model& model, PairGeometry geometry = PairGeometry())
      : PairGeometry(geometry) {
    using Smooth = SmoothCollision<AnyRestitutionModel, PairGeometry>;
    using Rough = RoughCollision<PairGeometry>;
    if (model.effects.contains("roughness"))
      rule_ = std::make_unique<Holder<Rough>>(Rough(model, std::move(geometry)));
    else
      rule_ =
          std::make_unique<Holder<Smooth>>(Smooth(AnyRestitutionModel(model), std::move(geometry)));
  }

  double collide(Particle& a, Particle& b, double now, const Box& box, Clock& clock) {
    return rule_->collide(a, b, now, box, clock);
  }
  void recall(const State& state) { rule_->recall(state); }
  void store(State& state) const { rule_->store(state); }
  void before_synchronization(std::span<const Particle> particles, double now) {
    rule_->before_synchronization(particles, now);
  }
  void scale(int exponent) { rule_->scale(exponent); }
  std::optional<Rotation> rotation() const { return rule_->rotation(); }
  std::size_t memory() const { return rule_->memory(); }

 private:
  struct Rule {
    Rule() = default;
    virtual ~Rule() = default;
    Rule(const Rule&) = delete;
    Rule& operator=(const Rule&) = delete;
    virtual double collide(Particle& a, Particle& b, double now, const Box& box, Clock& clock) = 0;
    virtual void recall(const State& state) = 0;
    virtual void store(State& state) const = 0;
    virtual void before_synchronization(std::span<const Particle> particles, double now) = 0;
    virtual void scale(int exponent) = 0;
    virtual std::optional<Rotation> rotation() const = 0;
    virtual std::size_t memory() const = 0;
  };

  template <class Collision>
  struct Holder : Rule {
    explicit Holder(Collision one) : held(std::move(one)) {}
    double collide(Particle& a, Particle& b, double now, const Box& box, Clock& clock) override {
      return held.collide(a, b, now, box, clock);
    }
    void recall(const State& state) override { held.recall(state); }
    void store(State& state) const override { held.store(state); }
    void before_synchronization(std::span<const Particle> particles, double now) override {
      held.before_synchronization(particles, now);
    }
    void scale(int exponent) override { held.scale(exponent); }
    std::optional<Rotation> rotation() const override { return held.rotation(); }
    std::size_t memory() const override { return held.memory(); }

    Collision held;
  };

  std::unique_ptr<Rule> rule_;
};

}  // namespace haff::engine
