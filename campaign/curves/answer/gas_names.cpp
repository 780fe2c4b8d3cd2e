// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/curves/answer/gas_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/printable.hpp"
#include "campaign/curves/labels.hpp"

namespace haff::campaign {
namespace {

std::vector<const Scene*> scenes_of(const std::vector<GasCurve>& curves) {
  std::vector<const Scene*> scenes;
  scenes.reserve(curves.size());
  for (const GasCurve& curve : curves) scenes.push_back(&curve.scene);
  return scenes;
}

}  // namespace

std::vector<std::string> names_for(const Question& question, const std::vector<GasCurve>& curves) {
  std::vector<std::string> names = question.by;
  for (std::string& name : varying(scenes_of(curves)))
    if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
  return names;
}

void sort_by(const std::vector<std::string>& names, std::vector<GasCurve>& curves) {
  std::ranges::stable_sort(curves, [&](const GasCurve& a, const GasCurve& b) {
    for (const std::string& name : names) {
      const ParameterValue *one = a.scene.find(name), *other = b.scene.find(name);
      if (one == nullptr || other == nullptr) {
        if (one != other) return one == nullptr;
        continue;
      }
      if (*one != *other) return *one < *other;
    }
    return false;
  });
}

std::string number_of(const std::string& name, const ParameterValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return printable(*text);
  const double number = std::get<double>(value);
  if (name == "N") return count_text(static_cast<long long>(number));
  return number_text(number);
}

// The tau of curves in a lag is the waiting time that they begin at.
std::string word_for(const std::string& name, const std::string& variable) {
  return name == "tau" && variable == "lag" ? "tau_w" : name;
}

std::string label_of(const Scene& scene, const std::vector<std::string>& names, bool enhanced,
                     const std::string& variable) {
  std::string text;
  for (const std::string& name : names) {
    const ParameterValue* value = scene.find(name);
    if (value == nullptr) continue;
    const std::string number = number_of(name, *value), word = word_for(name, variable);
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", enhanced ? symbol(word) : word,
                        enhanced ? literal(number) : number);
  }
  const bool lacks_effect = std::ranges::any_of(names, [&](const std::string& name) {
    return !effect_of(name).empty() && scene.find(name) == nullptr;
  });
  const bool has_effect = std::ranges::any_of(
      scene.parameters, [](const auto& each) { return !effect_of(each.first).empty(); });
  if (lacks_effect && !has_effect) text += text.empty() ? "no effect" : ", no effect";
  return text;
}

}  // namespace haff::campaign
