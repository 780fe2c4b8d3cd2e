// Parameters of laws and effects, by name, as a grid gives them.
#pragma once

#include <stdexcept>
#include <string>

#include "engine/simulation.hpp"

namespace haff::engine {

// A parameter that must be there and above zero. Throws std::invalid_argument.
inline double positive(const Parameters& parameters, const std::string& key) {
  const auto found = parameters.find(key);
  if (found == parameters.end() || !(found->second > 0))
    throw std::invalid_argument("the model needs " + key + " > 0");
  return found->second;
}

}  // namespace haff::engine
