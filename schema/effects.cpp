#include "schema/effects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "schema/rules.hpp"

namespace haff::schema {

namespace {

// Two that do not go together, and why.
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

bool asks_for(const Json& effects, std::string_view effect) {
  return effects.contains(std::string(effect));
}

}  // namespace

std::optional<std::string> law_without_e(const Json& effects) {
  const auto law = effects.value("/restitution/law"_json_pointer, std::string("constant"));
  return decides_e(law) ? std::optional(law) : std::nullopt;
}

std::optional<std::string> nonsense(const Json& effects) {
  for (const auto& [one, other, why] : exclusions)
    if (asks_for(effects, one) && asks_for(effects, other))
      return std::string(one) + " and " + std::string(other) + " " + std::string(why);
  return std::nullopt;
}

std::optional<std::string> beyond_haffs_law(const Json& effects) {
  for (const std::string_view effect : change_haffs_law)
    if (asks_for(effects, effect)) return std::string(effect);
  return std::nullopt;
}

bool lose_energy_at_e_1(const Json& effects) {
  return std::abs(effects.value("/roughness/beta"_json_pointer, 1.0)) < 1;
}

std::string effects_of_equilibration(const std::string& effects) {
  const Json all = Json::parse(effects);
  Json kept = Json::object();
  for (const auto& [effect, asked] : all.items())
    if (std::find(matter_in_equilibrium.begin(), matter_in_equilibrium.end(), effect) !=
        matter_in_equilibrium.end())
      kept[effect] = asked;
  return kept.dump();
}

}  // namespace haff::schema
