// Any law of restitution, chosen when it is made: for physics whose collisions cost more than a
// virtual call. One compilation of the event loop then serves all laws.
#pragma once

#include <memory>

#include "engine/law.hpp"

namespace haff::engine {

class AnyLaw {
 public:
  // Throws std::invalid_argument if there is no such law or it lacks a parameter.
  explicit AnyLaw(const Model& model);

  double operator()(const Impact& impact) const { return law_->restitution(impact); }

  void recall(const State& state) { law_->recall(state); }
  void store(State& state) const { law_->store(state); }
  void before_synchronization(std::span<const Particle> particles, double now) {
    law_->before_synchronization(particles, now);
  }
  void scale(int exponent) { law_->scale(exponent); }

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
  template <class Law>
  struct Holder;

  std::unique_ptr<Interface> law_;
};

}  // namespace haff::engine
