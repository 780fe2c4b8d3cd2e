// SPDX-License-Identifier: GPL-3.0-or-later

// The gas that a curve shows: its parameters by name, as a user asks for them.
//
//   d, e, n, N, equilibrate, sample_every     as in a grid
//   roughness.beta, thermostat.rate, ...      of an effect, where the gas has it
//   tau                                       of a profile
//   seed                                      of a single realization
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "schema/grid/job.hpp"

namespace haff::campaign {

using ParameterValue = std::variant<double, std::string>;

std::string value_text(const ParameterValue& value);

struct Scene {
  schema::Job job;  // of one of its realizations; what it observes is not the scene's
  std::vector<std::pair<std::string, ParameterValue>> parameters;  // in the order above

  const ParameterValue* find(std::string_view name) const;  // null: it has none of this name
  std::optional<double> number(std::string_view name) const;
};

// The scene of a job, without tau and seed.
Scene scene_of(const schema::Job& job);

// "roughness" of "roughness.beta"; empty for a parameter of no effect.
std::string effect_of(std::string_view parameter);

// Whether two scenes agree in all parameters but `but`, or, if `but` names an effect, in all but
// those of this effect.
bool agree(const Scene& one, const Scene& other, std::string_view but);

// Names of parameters that are not the same in all scenes, in the order above.
std::vector<std::string> varying(const std::vector<const Scene*>& scenes);

}  // namespace haff::campaign
