// SPDX-License-Identifier: GPL-3.0-or-later

#include "engine/restitution/any_restitution_model.hpp"

#include <utility>

#include "engine/restitution/restitution_models.hpp"

namespace haff::engine {

template <class RestitutionModel>
struct AnyRestitutionModel::Holder : Interface {
  explicit Holder(RestitutionModel one) : held(std::move(one)) {}
  double restitution(const Impact& impact) const override { return held(impact); }
  void recall(const State& state) override { held.recall(state); }
  void store(State& state) const override { held.store(state); }
  void before_synchronization(std::span<const Particle> particles, double now) override {
    held.before_synchronization(particles, now);
  }
  void scale(int exponent) override { held.scale(exponent); }

  RestitutionModel held;
};

AnyRestitutionModel::AnyRestitutionModel(const Model& model)
    : model_(with_restitution_model(
          model, []<class RestitutionModel>(RestitutionModel made) -> std::unique_ptr<Interface> {
            return std::make_unique<Holder<RestitutionModel>>(std::move(made));
          })) {}

}  // namespace haff::engine
