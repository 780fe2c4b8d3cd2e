// What a JSON schema cannot say of effects: which do not go together, and which matter at e = 1.
#pragma once

#include <optional>
#include <string>

#include "schema/document.hpp"

namespace haff::schema {

// Why a gas cannot have all these effects at once, or nothing. `effects` is one of those a grid
// asks for, without lists.
std::optional<std::string> nonsense(const Json& effects);

// Of a job's effects those that its equilibration has, too: they change what equilibrium is.
std::string effects_of_equilibration(const std::string& effects);

}  // namespace haff::schema
