// SPDX-License-Identifier: GPL-3.0-or-later

#include "schema/grid/effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "schema/grid/rules.hpp"

namespace haff::schema {

namespace {

// Two effects that do not go together, and why.
struct Exclusion {
  std::string_view one;
  std::string_view other;
  std::string_view why;
};

constexpr std::array<Exclusion, 1> exclusions{{
    {"mixture", "shuffle",
     "do not go together: species of different mass cannot exchange velocities"},
}};

// Heated, or with more than one temperature.
constexpr std::array<std::string_view, 3> change_haffs_law{"mixture", "roughness", "thermostat"};

constexpr std::array<std::string_view, 1> matter_in_equilibrium{"mixture"};

using Json = nlohmann::json;

}  // namespace

Effects::Effects(std::string_view json) {
  const Json all = Json::parse(json, nullptr, false);
  if (!all.is_object())
    throw std::invalid_argument("not a JSON object of effects: " + std::string(json));
  for (const auto& [effect, asked] : all.items()) {
    if (!asked.is_object())
      throw std::invalid_argument("the effect " + effect +
                                  " is no JSON object of parameters: " + asked.dump());
    Parameters& parameters = by_name_[effect];
    for (const auto& [name, value] : asked.items()) {
      const bool is_law = effect == "restitution" && name == "law";
      if (is_law && value.is_string())
        law_ = value.get<std::string>();
      else if (is_law)
        throw std::invalid_argument("the law of restitution is no name: " + value.dump());
      else if (value.is_number())
        parameters[name] = value.get<double>();
      else
        throw std::invalid_argument(fmt::format(
            "the parameter {} of the effect {} is no number: {}", name, effect, value.dump()));
    }
  }
  text_ = all.dump();
}

std::optional<double> Effects::parameter(std::string_view effect, const std::string& name) const {
  const auto asked = by_name_.find(effect);
  if (asked == by_name_.end()) return std::nullopt;
  const auto found = asked->second.find(name);
  return found == asked->second.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::string> law_without_e(const Effects& effects) {
  return decides_e(effects.law()) ? std::optional(effects.law()) : std::nullopt;
}

std::optional<std::string> nonsense(const Effects& effects) {
  for (const auto& [one, other, why] : exclusions)
    if (effects.contains(one) && effects.contains(other))
      return std::string(one) + " and " + std::string(other) + " " + std::string(why);
  return std::nullopt;
}

std::optional<std::string> beyond_haffs_law(const Effects& effects) {
  for (const std::string_view effect : change_haffs_law)
    if (effects.contains(effect)) return std::string(effect);
  return std::nullopt;
}

bool lose_energy_at_e_1(const Effects& effects) {
  return std::abs(effects.parameter("roughness", "beta").value_or(1)) < 1;
}

Effects effects_of_equilibration(const Effects& effects) {
  const Json all = Json::parse(effects.text());
  Json kept = Json::object();
  for (const auto& [effect, asked] : all.items())
    if (std::find(matter_in_equilibrium.begin(), matter_in_equilibrium.end(), effect) !=
        matter_in_equilibrium.end())
      kept[effect] = asked;
  return kept.dump();
}

}  // namespace haff::schema
