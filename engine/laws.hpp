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

#include <tuple>

#include "engine/constant_restitution.hpp"
#include "engine/contact_duration.hpp"
#include "engine/elastic_threshold.hpp"

namespace haff::engine {

using Laws = std::tuple<ConstantRestitution, ElasticThreshold, ContactDuration>;

}  // namespace haff::engine
