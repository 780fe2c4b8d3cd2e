#include "schema/effects.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace haff::schema {

namespace {

// Two that do not go together, and why: an effect's name, or "effect/key=word" for one of its
// kinds.
struct Exclusion {
  std::string_view one;
  std::string_view other;
  std::string_view why;
};

constexpr std::array<Exclusion, 4> exclusions{{
    {"mixture", "roughness", "rough spheres are equal ones"},
    {"mixture", "shuffle", "species of different mass cannot exchange velocities"},
    {"mixture", "thermostat", "its noise is that of equal masses"},
    {"mixture", "restitution/law=viscoelastic", "A depends on the sizes and masses of a pair"},
}};

constexpr std::array<std::string_view, 1> matter_in_equilibrium{"mixture"};

bool asks_for(const Json& effects, std::string_view what) {
  const std::string effect(what.substr(0, what.find('/')));
  if (!effects.contains(effect)) return false;
  if (effect.size() == what.size()) return true;
  const std::string_view kind = what.substr(effect.size() + 1);
  const std::size_t equals = kind.find('=');
  return effects[effect].value(kind.substr(0, equals), "") == kind.substr(equals + 1);
}

}  // namespace

std::optional<std::string> nonsense(const Json& effects) {
  for (const auto& [one, other, why] : exclusions)
    if (asks_for(effects, one) && asks_for(effects, other))
      return std::string(one) + " and " + std::string(other) +
             " do not go together: " + std::string(why);
  return std::nullopt;
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
