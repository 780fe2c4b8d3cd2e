// SPDX-License-Identifier: GPL-3.0-or-later

// Restitution models: the restitution coefficient e as a function of the collision.
//
// Each model is a class in a file of its own:
//
//   class SomeModel : public Memoryless {           // unless it remembers something
//    public:
//     static constexpr std::string_view name = "some";           // its name in a grid
//     SomeModel(double e, const Parameters& parameters);          // throws std::invalid_argument
//     double operator()(const Impact& impact) const;              // e of this collision
//     void scale(int exponent);                                   // units of speed: see Memoryless
//   };
//
// and a line in the list below. The event loop is compiled with each of them; a gas runs the loop
// that its model asks for, and has neither data nor instructions of the other models.
#pragma once

#include <stdexcept>
#include <tuple>

#include "engine/restitution/constant_restitution.hpp"
#include "engine/restitution/contact_duration.hpp"
#include "engine/restitution/elastic_threshold.hpp"
#include "engine/restitution/plastic_impact.hpp"
#include "engine/restitution/viscoelastic.hpp"

namespace haff::engine {

using RestitutionModels =
    std::tuple<ConstantRestitution, ElasticThreshold, ContactDuration, Viscoelastic, PlasticImpact>;

// Calls `make` with the restitution model that the model asks for and returns the result. Throws
// std::invalid_argument if there is no such restitution model.
template <class Make>
auto with_restitution_model(const Model& model, const Make& make) {
  decltype(make(ConstantRestitution(1))) made;
  const auto try_model = [&]<class RestitutionModel>(const RestitutionModel*) {
    if (RestitutionModel::name == model.law.name)
      made = make(RestitutionModel(model.restitution, model.law.parameters));
  };
  [&]<class... RestitutionModel>(const std::tuple<RestitutionModel...>*) {
    (try_model(static_cast<const RestitutionModel*>(nullptr)), ...);
  }(static_cast<const RestitutionModels*>(nullptr));
  if (!made) throw std::invalid_argument("there is no restitution model called " + model.law.name);
  return made;
}

}  // namespace haff::engine
