// Laws of restitution: with which e two spheres part, by what is known of their collision.
//
// Each is a class in a file of its own:
//
//   class SomeLaw : public Forgetful {              // unless it remembers something
//    public:
//     static constexpr std::string_view name = "some";           // its name in a grid
//     SomeLaw(double e, const Parameters& parameters);            // throws std::invalid_argument
//     double operator()(const Impact& impact) const;              // e of this collision
//     void scale(int exponent);                                   // units of speed: see Forgetful
//   };
//
// and a line in the list below. The event loop is compiled with each; a gas runs the one it asks
// for, and has nothing of the others.
#pragma once

#include <stdexcept>
#include <tuple>

#include "engine/constant_restitution.hpp"
#include "engine/contact_duration.hpp"
#include "engine/elastic_threshold.hpp"
#include "engine/plastic_impact.hpp"
#include "engine/viscoelastic.hpp"

namespace haff::engine {

using Laws =
    std::tuple<ConstantRestitution, ElasticThreshold, ContactDuration, Viscoelastic, PlasticImpact>;

// What `make` makes of the law that the model asks for. Throws std::invalid_argument if there is
// none.
template <class Make>
auto with_law(const Model& model, const Make& make) {
  decltype(make(ConstantRestitution(1))) made;
  const auto try_law = [&]<class Law>(const Law*) {
    if (Law::name == model.law.name) made = make(Law(model.restitution, model.law.parameters));
  };
  [&]<class... Law>(const std::tuple<Law...>*) {
    (try_law(static_cast<const Law*>(nullptr)), ...);
  }(static_cast<const Laws*>(nullptr));
  if (!made) throw std::invalid_argument("there is no law of restitution " + model.law.name);
  return made;
}

}  // namespace haff::engine
