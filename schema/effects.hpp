// What a JSON schema cannot say of effects: which do not go together, which matter at e = 1, and
// which leave Haff's law as it is.
#pragma once

#include <optional>
#include <string>

#include "schema/document.hpp"

namespace haff::schema {

// Here `effects` is one of those a grid asks for, without lists.

// The law of restitution that gives every collision an e of its own, if they name one; there is
// then no e to choose.
std::optional<std::string> law_without_e(const Json& effects);

// Why a gas cannot have all these effects at once, or nothing.
std::optional<std::string> nonsense(const Json& effects);

// One of them with which a gas of constant e does not cool as Haff's law says, or nothing.
std::optional<std::string> beyond_haffs_law(const Json& effects);

// Whether energy is lost where e = 1, all the same: by rough spheres, unless their surfaces slip
// freely or grip perfectly.
bool lose_energy_at_e_1(const Json& effects);

// Of a job's effects those that its equilibration has, too: they change what equilibrium is.
std::string effects_of_equilibration(const std::string& effects);

}  // namespace haff::schema
