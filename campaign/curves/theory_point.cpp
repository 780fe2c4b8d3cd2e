// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/theory_point.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace haff::campaign {
namespace {

double number(const schema::Effects& effects, const std::string& effect, const char* name,
              const std::string& of) {
  const auto value = effects.parameter(effect, name);
  if (!value) throw TheoryError(fmt::format("--effects: {} needs a number {}", of, name));
  return *value;
}

double positive(const schema::Effects& effects, const std::string& effect, const char* name,
                const std::string& of) {
  const double value = number(effects, effect, name, of);
  if (!(value > 0))
    throw TheoryError(fmt::format("--effects: {} needs a number {} above 0", of, name));
  return value;
}

analysis::Restitution law_of(const schema::Effects& effects, double e) {
  const std::string& law = effects.law();
  const auto of = [&](const char* name) { return positive(effects, "restitution", name, law); };
  if (law == "constant") return analysis::ConstantRestitution{e};
  if (law == "threshold") return analysis::ThresholdRestitution{e, of("speed")};
  if (law == "tc") return analysis::ContactDurationRestitution{e, of("t_c")};
  if (law == "viscoelastic") return analysis::ViscoelasticRestitution{of("A")};
  if (law == "plastic") return analysis::PlasticRestitution{of("speed")};
  throw TheoryError(fmt::format("--effects: no law of restitution is called {}", law));
}

}  // namespace

void add_effects(const std::string& text, TheoryPoint& at) {
  schema::Effects effects;
  try {
    effects = text;
  } catch (const std::invalid_argument& wrong) {
    throw TheoryError(
        fmt::format("--effects: {}; expected a JSON object as in a grid, e.g. "
                    "'{{\"restitution\": {{\"law\": \"viscoelastic\", \"A\": 0.05}}}}'",
                    wrong.what()));
  }
  add_effects(effects, at);
}

void add_effects(const schema::Effects& effects, TheoryPoint& at) {
  const auto number_of = [&](const std::string& effect, const char* name) {
    return number(effects, effect, name, effect);
  };
  const auto positive_of = [&](const std::string& effect, const char* name) {
    return positive(effects, effect, name, effect);
  };
  for (const auto& each : effects.by_name()) {
    const std::string& name = each.first;
    if (name == "restitution") {
      at.gas.law = law_of(effects, at.e);
      at.other_law = at.other_law || effects.law() != "constant";
    } else if (name == "thermostat") {
      at.gas.heating = positive_of(name, "rate");
      at.other_law = true;
    } else if (name == "shuffle") {
      at.is_shuffled = true;
    } else if (name == "roughness") {
      at.roughness = analysis::Roughness{
          .beta = number_of(name, "beta"), .q = positive_of(name, "q"), .d = at.d};
    } else if (name == "mixture") {
      at.mixture = analysis::BinaryMixture{.e = at.e,
                                           .n = at.n,
                                           .fraction = number_of(name, "fraction"),
                                           .diameter_ratio = positive_of(name, "diameter_ratio"),
                                           .mass_ratio = positive_of(name, "mass_ratio"),
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
