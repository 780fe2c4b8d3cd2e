// SPDX-License-Identifier: GPL-3.0-or-later

// Parameters of restitution models and effects, by name, as a grid gives them.
#pragma once

#include <stdexcept>
#include <string>

#include "engine/simulation.hpp"

namespace haff::engine {

// A parameter that is required and must be above zero. Throws std::invalid_argument otherwise.
inline double positive(const Parameters& parameters, const std::string& key) {
  const auto found = parameters.find(key);
  if (found == parameters.end() || !(found->second > 0))
    throw std::invalid_argument("the model needs " + key + " > 0");
  return found->second;
}

}  // namespace haff::engine
