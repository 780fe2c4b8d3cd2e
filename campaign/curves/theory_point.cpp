#include "campaign/curves/theory_point.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace haff::campaign {
namespace {

using nlohmann::json;

double number(const json& effect, const std::string& name, const char* key) {
  if (!effect.contains(key) || !effect[key].is_number())
    throw TheoryError(fmt::format("--effects: {} needs a number {}", name, key));
  return effect[key];
}

double positive(const json& effect, const std::string& name, const char* key) {
  const double value = number(effect, name, key);
  if (!(value > 0))
    throw TheoryError(fmt::format("--effects: {} needs a number {} above 0", name, key));
  return value;
}

analysis::Restitution law_of(const json& restitution, double e) {
  const std::string law = restitution.value("law", "constant");
  const auto of = [&](const char* key) { return positive(restitution, law, key); };
  if (law == "constant") return analysis::ConstantRestitution{e};
  if (law == "threshold") return analysis::ThresholdRestitution{e, of("speed")};
  if (law == "tc") return analysis::ContactDurationRestitution{e, of("t_c")};
  if (law == "viscoelastic") return analysis::ViscoelasticRestitution{of("A")};
  if (law == "plastic") return analysis::PlasticRestitution{of("speed")};
  throw TheoryError(fmt::format("--effects: no law of restitution is called {}", law));
}

}  // namespace

void add_effects(const std::string& text, TheoryPoint& at) {
  const json effects = json::parse(text, nullptr, false);
  if (!effects.is_object())
    throw TheoryError(
        "--effects: expected a JSON object as in a grid, e.g. "
        "'{\"restitution\": {\"law\": \"viscoelastic\", \"A\": 0.05}}'");
  for (const auto& [name, effect] : effects.items()) {
    if (name == "restitution") {
      at.gas.law = law_of(effect, at.e);
      at.other_law = at.other_law || effect.value("law", "constant") != "constant";
    } else if (name == "thermostat") {
      at.gas.heating = positive(effect, name, "rate");
      at.other_law = true;
    } else if (name == "shuffle") {
      at.is_shuffled = true;
    } else if (name == "roughness") {
      at.roughness = analysis::Roughness{
          .beta = number(effect, name, "beta"), .q = positive(effect, name, "q"), .d = at.d};
    } else if (name == "mixture") {
      at.mixture =
          analysis::BinaryMixture{.e = at.e,
                                  .n = at.n,
                                  .fraction = number(effect, name, "fraction"),
                                  .diameter_ratio = positive(effect, name, "diameter_ratio"),
                                  .mass_ratio = positive(effect, name, "mass_ratio"),
                                  .d = at.d};
    } else {
      throw TheoryError(fmt::format(
          "--effects: no theory here treats {}; known are restitution, thermostat, shuffle, "
          "roughness and mixture",
          name));
    }
  }
}

TheoryPoint theory_point(const schema::Job& job) {
  TheoryPoint at;
  at.d = job.d;
  at.n = job.n;
  at.e = job.e.value_or(1);
  at.gas = {.law = analysis::ConstantRestitution{at.e}, .d = at.d, .n = at.n};
  add_effects(job.effects, at);
  return at;
}

bool knows(const TheoryCurve& curve, const TheoryPoint& at) {
  const bool rough = at.roughness.has_value(), mixed = at.mixture.has_value();
  switch (curve.treats) {
    case Treats::correlated:
      return !rough && !mixed && !at.other_law && !at.is_shuffled;
    case Treats::smooth:
      return !rough && !mixed && !at.other_law;
    case Treats::any_law:
      return !rough && !mixed;
    case Treats::any_law_or_rough:
      return !mixed && !(rough && at.other_law);
    case Treats::rough:
      return rough && !mixed && !at.other_law;
    case Treats::mixture:
      return mixed && !rough && (!at.other_law || at.gas.heating > 0);
  }
  return false;
}

}  // namespace haff::campaign
