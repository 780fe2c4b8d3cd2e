// SPDX-License-Identifier: GPL-3.0-or-later

// Any restitution model, chosen at run time, for physics whose collisions cost more than a virtual
// call. One compilation of the event loop then serves all restitution models.
#pragma once

#include <memory>

#include "engine/restitution/restitution_model.hpp"

namespace haff::engine {

class AnyRestitutionModel {
 public:
  // Throws std::invalid_argument if there is no such model or it lacks a parameter.
  explicit AnyRestitutionModel(const Model& model);

  double operator()(const Impact& impact) const { return model_->restitution(impact); }

  void recall(const State& state) { model_->recall(state); }
  void store(State& state) const { model_->store(state); }
  void before_synchronization(std::span<const Particle> particles, double now) {
    model_->before_synchronization(particles, now);
  }
  void scale(int exponent) { model_->scale(exponent); }

 private:
  struct Interface {
    Interface() = default;
    virtual ~Interface() = default;
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;
    virtual double restitution(const Impact& impact) const = 0;
    virtual void recall(const State& state) = 0;
    virtual void store(State& state) const = 0;
    virtual void before_synchronization(std::span<const Particle> particles, double now) = 0;
    virtual void scale(int exponent) = 0;
  };
  template <class RestitutionModel>
  struct Holder;

  std::unique_ptr<Interface> model_;
};

}  // namespace haff::engine
